// JSON that nests a million deep is refused like any other that is not the document expected: nothing walks it by recursion.
#include <string>

#include <doctest/doctest.h>

#include "cli/exit_code.h"
#include "tests/cli/run_command.h"

using namespace etalon::test;
using namespace etalon::cli;

TEST_CASE("deep JSON: view files and waivers") {
  const ScratchFolder folder;
  const std::string nest = std::string(1'000'000, '[') + std::string(1'000'000, ']');
  const std::string model = folder.file("m.obj", square_obj());
  for (const std::string member : {"schema", "eye", "near", "width"}) {
    CAPTURE(member);
    std::string text =
        R"({"schema":"etalon/view/1","eye":[0,0,3],"target":[0,0,0],"up":[0,1,0],"tan_half_fov_y":0.5,"near":0.1,"far":9,"width":8,"height":8})";
    const std::size_t begin = text.find("\"" + member + "\":") + member.size() + 3;
    const std::size_t end = text.find(",\"", begin);
    folder.file("view.json", text.replace(begin, end - begin, nest));
    check_refused({"render", model, "--view", (folder.path() / "view.json").string(), "-o", (folder.path() / "o.png").string()},
                  kExitBadInput, folder, "view.json: '" + member);
  }
  REQUIRE(run_etalon({"render", model, "--size", "8", "-o", (folder.path() / "a.png").string()}).exit_code == 0);
  const std::string image = (folder.path() / "a.png").string();
  folder.file("waivers.json", "{\"schema\":" + nest + "}");
  check_refused({"diff", image, image, "--device", "gl", "--waivers", (folder.path() / "waivers.json").string()}, kExitBadInput, folder,
                "waivers.json: ");
  folder.file("waivers.json", "{\"schema\":\"etalon/waivers/1\",\"waivers\":[{\"pair\":" + nest + "}]}");
  check_refused({"diff", image, image, "--device", "gl", "--waivers", (folder.path() / "waivers.json").string()}, kExitBadInput, folder,
                "waivers[0].pair");
}
