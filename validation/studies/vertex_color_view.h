// The image comparison of [Kim, Choi & Lee 2008, sec. 5.4]: a mesh drawn unlit in its vertex colours, and how far two such pictures are apart.
#pragma once

#include <optional>

#include "core/draw/camera.h"
#include "core/draw/renderer.h"
#include "validation/bounds.h"
#include "validation/studies/study_scene.h"
#include "validation/texel_diff.h"

namespace etalon::validation {

struct VertexColorView {
  Camera camera;
  int width = 1024;
  int height = 1024;
};

/// The draw list and the frame (colour as RGBA unorm8 on black, the default clear colour of OpenGL; triangle ids) of one view.
/// InputError where the mesh has no vertex colours or breaks the contract's ranges.
[[nodiscard]] StudyScene vertex_color_scene(const Mesh& mesh, const VertexColorView& view, const RasterState& state = {});

struct DrawnView {
  Image color;
  Image id;  ///< kNoTriangle where nothing is shown
};
[[nodiscard]] DrawnView draw_view(Renderer& renderer, const Mesh& mesh, const VertexColorView& view);
/// The colours alone.
[[nodiscard]] Image draw_vertex_colors(Renderer& renderer, const Mesh& mesh, const VertexColorView& view);

/// √(Σ (Δr² + Δg² + Δb²) / texels) over the whole image, in steps of 1/255: the RMS of the Euclidean distances between corresponding pixels.
/// The sum is an exact integer. Both RGBA or RGB unorm8 of one size, else InputError.
[[nodiscard]] double rgb_rms(const Image& a, const Image& b);

/// The same error taken apart, to tell colours from outlines.
struct PictureError {
  double rms = 0;            ///< rgb_rms
  double inside_rms = 0;     ///< over the texels in which both pictures show a surface
  double outline_share = 0;  ///< of the sum of squares, what lies in texels in which only one of the pictures does; 0 to 1
};
[[nodiscard]] PictureError picture_error(const DrawnView& a, const DrawnView& b);

/// The smallest square around what `view` shows, 8 texels wider on each side: its centre and side; the whole frame where nothing is shown.
struct ShownSquare {
  int x = 0, y = 0, side = 0;
};
[[nodiscard]] ShownSquare shown_square(const DrawnView& view);

/// The same view on a device, in a state that it supports (sub-texel bits), and every texel that differs put in a class.
struct DeviceView {
  Image color;
  DiffResult diff;  ///< of colours and ids
};
/// UnavailableError where the device cannot draw it.
[[nodiscard]] DeviceView draw_on_device(Renderer& exact, Renderer& device, const DeviceModel& model, const Mesh& mesh,
                                        const VertexColorView& view);

/// The part of `view` around the point (x, y) of the frame, 0 to 1 from its lower left, enlarged `factor` times: same eye, narrower angle.
[[nodiscard]] VertexColorView close_up(const VertexColorView& view, double x, double y, double factor);

/// Where `a` and `b` differ most: the centre, 0 to 1, of the window of 1/factor of the frame's sides with the largest sum of squared
/// differences (on a raster of an eighth of the window); {½, ½} where nothing differs.
[[nodiscard]] Vec2d worst_window(const Image& a, const Image& b, double factor);

}  // namespace etalon::validation
