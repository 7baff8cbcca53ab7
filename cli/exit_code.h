// What the process says to its caller.
#pragma once

namespace etalon::cli {

inline constexpr int kExitDone = 0;         ///< done; the two sides agree
inline constexpr int kExitWarning = 1;      ///< done with a reservation: nothing could be compared, or a tie is not proven
inline constexpr int kExitCheckFailed = 2;  ///< an unexplained texel
inline constexpr int kExitSizesDiffer = 3;  ///< two images to compare have different sizes
inline constexpr int kExitBadInput = 4;     ///< bad input, file or write error
inline constexpr int kExitUsage = 64;       ///< the command line itself (EX_USAGE)
inline constexpr int kExitInterrupted = 130;

}  // namespace etalon::cli
