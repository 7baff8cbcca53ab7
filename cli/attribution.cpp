#include "cli/attribution.h"

#include <array>
#include <string_view>

namespace etalon::cli {
namespace {

struct Credit {
  std::string_view sha256;
  std::string_view text;
};

constexpr std::string_view kHead = "Infinite-Realities / Lee Perry-Smith, CC BY 3.0";
constexpr std::string_view kHeadDerived = "derived from the head scan by Infinite-Realities / Lee Perry-Smith, CC BY 3.0";
constexpr std::string_view kSpot = "Spot, by Keenan Crane";

constexpr std::array<Credit, 6> kCredits{{
    {"402b8a8ac9f03232e6d64b5962929703a069daf99d3c49ac8eb0e48bedc9c576", kHead},         // LeePerrySmith.glb
    {"e976d73b31407f8d0967412bf468019ed26a5d5a32cf5811aabff7e816458a65", kHead},         // Map-COL.jpg
    {"36925e51ad9b324b94e8faf4692da1b4132809f2762bb8d5bd549ffd215d4ca6", kHead},         // Infinite-Level_02_Tangent_SmoothUV.jpg
    {"51f94533e94db550b44e82fa0d579c6a4e6a9b917d7a641428d610476b8ae9e9", kHeadDerived},  // lee_perry_smith_283k.ply
    {"edceffe20092832e8d27956193816ab311507daf00510cce360d7e497613945d", kSpot},         // spot_triangulated.obj
    {"cddabbae52a666173e7953e238b88340d285044dc20b36f8ed3f1a41db534fa5", kSpot},         // spot_texture.png
}};

}  // namespace

std::string attribution_of(const std::string& sha256) {
  for (const Credit& credit : kCredits) {
    if (credit.sha256 == sha256) return std::string(credit.text);
  }
  return "";
}

}  // namespace etalon::cli
