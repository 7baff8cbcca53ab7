// In a process of its own, since Mesa's driver is chosen once: a name Mesa would crash on is refused in words.
#include <cstdlib>
#include <string>

#include <doctest/doctest.h>

#include "core/base/error.h"
#include "gpu/context.h"

TEST_CASE("a driver that Mesa does not know, left in the environment, is UnavailableError") {
  setenv("GALLIUM_DRIVER", "nonsense", 1);
  try {
    (void)etalon::gpu::make_context({});
    FAIL("accepted");
  } catch (const etalon::UnavailableError& error) {
    CHECK(std::string(error.what()).find("got 'nonsense'") != std::string::npos);
  }
}
