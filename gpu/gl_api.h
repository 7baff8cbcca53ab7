// The few names of OpenGL 3.3 core that etalon uses, and a table of its functions filled at run time.
// Declared here so that neither a GL header nor a GL library is needed to build; tests/gpu compares the numbers with
// <GL/glcorearb.h> where that header is installed.
// Does not: load extensions, or know anything newer than 3.3 core.
#pragma once

#include <cstddef>
#include <functional>
#include <string>

namespace etalon::gpu::gl {

using Enum = unsigned int;
using Boolean = unsigned char;
using Bitfield = unsigned int;
using Int = int;
using Uint = unsigned int;
using Sizei = int;
using Sizeiptr = std::ptrdiff_t;
using Float = float;
using Double = double;
using Char = char;
using Ubyte = unsigned char;

// clang-format off
// F(constant, OpenGL's name without GL_, value): OpenGL 3.3 core, from the registry's numbers.
#define ETALON_GL_CONSTANTS(F) \
  F(kNoError, NO_ERROR, 0) \
  F(kInvalidEnum, INVALID_ENUM, 0x0500) \
  F(kInvalidValue, INVALID_VALUE, 0x0501) \
  F(kInvalidOperation, INVALID_OPERATION, 0x0502) \
  F(kOutOfMemory, OUT_OF_MEMORY, 0x0505) \
  F(kInvalidFramebufferOperation, INVALID_FRAMEBUFFER_OPERATION, 0x0506) \
  F(kTriangles, TRIANGLES, 0x0004) \
  F(kLess, LESS, 0x0201) \
  F(kAlways, ALWAYS, 0x0207) \
  F(kBack, BACK, 0x0405) \
  F(kCw, CW, 0x0900) \
  F(kCcw, CCW, 0x0901) \
  F(kCullFace, CULL_FACE, 0x0B44) \
  F(kDepthTest, DEPTH_TEST, 0x0B71) \
  F(kStencilTest, STENCIL_TEST, 0x0B90) \
  F(kScissorTest, SCISSOR_TEST, 0x0C11) \
  F(kDither, DITHER, 0x0BD0) \
  F(kBlend, BLEND, 0x0BE2) \
  F(kMultisample, MULTISAMPLE, 0x809D) \
  F(kDepthClamp, DEPTH_CLAMP, 0x864F) \
  F(kFramebufferSrgb, FRAMEBUFFER_SRGB, 0x8DB9) \
  F(kUnpackAlignment, UNPACK_ALIGNMENT, 0x0CF5) \
  F(kPackAlignment, PACK_ALIGNMENT, 0x0D05) \
  F(kMaxTextureSize, MAX_TEXTURE_SIZE, 0x0D33) \
  F(kMaxViewportDims, MAX_VIEWPORT_DIMS, 0x0D3A) \
  F(kMaxRenderbufferSize, MAX_RENDERBUFFER_SIZE, 0x84E8) \
  F(kMaxDrawBuffers, MAX_DRAW_BUFFERS, 0x8824) \
  F(kSubpixelBits, SUBPIXEL_BITS, 0x0D50) \
  F(kTexture2d, TEXTURE_2D, 0x0DE1) \
  F(kUnsignedByte, UNSIGNED_BYTE, 0x1401) \
  F(kUnsignedShort, UNSIGNED_SHORT, 0x1403) \
  F(kUnsignedInt, UNSIGNED_INT, 0x1405) \
  F(kFloat, FLOAT, 0x1406) \
  F(kHalfFloat, HALF_FLOAT, 0x140B) \
  F(kColor, COLOR, 0x1800) \
  F(kDepth, DEPTH, 0x1801) \
  F(kDepthComponent, DEPTH_COMPONENT, 0x1902) \
  F(kRed, RED, 0x1903) \
  F(kRgb, RGB, 0x1907) \
  F(kRgba, RGBA, 0x1908) \
  F(kRg, RG, 0x8227) \
  F(kRedInteger, RED_INTEGER, 0x8D94) \
  F(kRgInteger, RG_INTEGER, 0x8228) \
  F(kRgbInteger, RGB_INTEGER, 0x8D98) \
  F(kRgbaInteger, RGBA_INTEGER, 0x8D99) \
  F(kVendor, VENDOR, 0x1F00) \
  F(kRenderer, RENDERER, 0x1F01) \
  F(kVersion, VERSION, 0x1F02) \
  F(kMajorVersion, MAJOR_VERSION, 0x821B) \
  F(kMinorVersion, MINOR_VERSION, 0x821C) \
  F(kNearest, NEAREST, 0x2600) \
  F(kLinear, LINEAR, 0x2601) \
  F(kTextureMagFilter, TEXTURE_MAG_FILTER, 0x2800) \
  F(kTextureMinFilter, TEXTURE_MIN_FILTER, 0x2801) \
  F(kTextureWrapS, TEXTURE_WRAP_S, 0x2802) \
  F(kTextureWrapT, TEXTURE_WRAP_T, 0x2803) \
  F(kTextureBaseLevel, TEXTURE_BASE_LEVEL, 0x813C) \
  F(kTextureMaxLevel, TEXTURE_MAX_LEVEL, 0x813D) \
  F(kRepeat, REPEAT, 0x2901) \
  F(kClampToEdge, CLAMP_TO_EDGE, 0x812F) \
  F(kMirroredRepeat, MIRRORED_REPEAT, 0x8370) \
  F(kTexture0, TEXTURE0, 0x84C0) \
  F(kArrayBuffer, ARRAY_BUFFER, 0x8892) \
  F(kElementArrayBuffer, ELEMENT_ARRAY_BUFFER, 0x8893) \
  F(kStreamDraw, STREAM_DRAW, 0x88E0) \
  F(kStaticDraw, STATIC_DRAW, 0x88E4) \
  F(kFragmentShader, FRAGMENT_SHADER, 0x8B30) \
  F(kVertexShader, VERTEX_SHADER, 0x8B31) \
  F(kCompileStatus, COMPILE_STATUS, 0x8B81) \
  F(kLinkStatus, LINK_STATUS, 0x8B82) \
  F(kInfoLogLength, INFO_LOG_LENGTH, 0x8B84) \
  F(kFramebuffer, FRAMEBUFFER, 0x8D40) \
  F(kRenderbuffer, RENDERBUFFER, 0x8D41) \
  F(kFramebufferComplete, FRAMEBUFFER_COMPLETE, 0x8CD5) \
  F(kColorAttachment0, COLOR_ATTACHMENT0, 0x8CE0) \
  F(kDepthAttachment, DEPTH_ATTACHMENT, 0x8D00) \
  F(kNone, NONE, 0) \
  F(kR8, R8, 0x8229) \
  F(kRg8, RG8, 0x822B) \
  F(kRgb8, RGB8, 0x8051) \
  F(kRgba8, RGBA8, 0x8058) \
  F(kR16, R16, 0x822A) \
  F(kRg16, RG16, 0x822C) \
  F(kRgb16, RGB16, 0x8054) \
  F(kRgba16, RGBA16, 0x805B) \
  F(kR16f, R16F, 0x822D) \
  F(kRg16f, RG16F, 0x822F) \
  F(kRgb16f, RGB16F, 0x881B) \
  F(kRgba16f, RGBA16F, 0x881A) \
  F(kR32f, R32F, 0x822E) \
  F(kRg32f, RG32F, 0x8230) \
  F(kRgb32f, RGB32F, 0x8815) \
  F(kRgba32f, RGBA32F, 0x8814) \
  F(kR8ui, R8UI, 0x8232) \
  F(kRg8ui, RG8UI, 0x8238) \
  F(kRgb8ui, RGB8UI, 0x8D7D) \
  F(kRgba8ui, RGBA8UI, 0x8D7C) \
  F(kR16ui, R16UI, 0x8234) \
  F(kRg16ui, RG16UI, 0x823A) \
  F(kRgb16ui, RGB16UI, 0x8D77) \
  F(kRgba16ui, RGBA16UI, 0x8D76) \
  F(kR32ui, R32UI, 0x8236) \
  F(kRg32ui, RG32UI, 0x823C) \
  F(kRgb32ui, RGB32UI, 0x8D71) \
  F(kRgba32ui, RGBA32UI, 0x8D70) \
  F(kDepthComponent32f, DEPTH_COMPONENT32F, 0x8CAC)

#define ETALON_GL_DECLARE_CONSTANT(constant, name, value) inline constexpr Enum constant = value;
ETALON_GL_CONSTANTS(ETALON_GL_DECLARE_CONSTANT)
#undef ETALON_GL_DECLARE_CONSTANT

// F(result, member, OpenGL's name without gl, parameters)
#define ETALON_GL_FUNCTIONS(F) \
  F(Enum, get_error, GetError, ()) \
  F(const Ubyte*, get_string, GetString, (Enum name)) \
  F(void, get_integerv, GetIntegerv, (Enum name, Int* values)) \
  F(void, enable, Enable, (Enum capability)) \
  F(void, disable, Disable, (Enum capability)) \
  F(void, viewport, Viewport, (Int x, Int y, Sizei width, Sizei height)) \
  F(void, depth_func, DepthFunc, (Enum function)) \
  F(void, depth_mask, DepthMask, (Boolean enabled)) \
  F(void, depth_range, DepthRange, (Double near_value, Double far_value)) \
  F(void, color_mask, ColorMask, (Boolean red, Boolean green, Boolean blue, Boolean alpha)) \
  F(void, cull_face, CullFace, (Enum face)) \
  F(void, front_face, FrontFace, (Enum orientation)) \
  F(void, pixel_storei, PixelStorei, (Enum name, Int value)) \
  F(void, read_pixels, ReadPixels, (Int x, Int y, Sizei width, Sizei height, Enum format, Enum type, void* data)) \
  F(void, read_buffer, ReadBuffer, (Enum buffer)) \
  F(void, draw_buffers, DrawBuffers, (Sizei count, const Enum* buffers)) \
  F(void, draw_arrays, DrawArrays, (Enum mode, Int first, Sizei count)) \
  F(void, draw_elements, DrawElements, (Enum mode, Sizei count, Enum type, const void* offset)) \
  F(void, finish, Finish, ()) \
  F(void, clear_bufferfv, ClearBufferfv, (Enum buffer, Int index, const Float* value)) \
  F(void, clear_bufferuiv, ClearBufferuiv, (Enum buffer, Int index, const Uint* value)) \
  F(void, gen_buffers, GenBuffers, (Sizei count, Uint* ids)) \
  F(void, delete_buffers, DeleteBuffers, (Sizei count, const Uint* ids)) \
  F(void, bind_buffer, BindBuffer, (Enum target, Uint id)) \
  F(void, buffer_data, BufferData, (Enum target, Sizeiptr size_bytes, const void* data, Enum usage)) \
  F(void, gen_vertex_arrays, GenVertexArrays, (Sizei count, Uint* ids)) \
  F(void, delete_vertex_arrays, DeleteVertexArrays, (Sizei count, const Uint* ids)) \
  F(void, bind_vertex_array, BindVertexArray, (Uint id)) \
  F(void, enable_vertex_attrib_array, EnableVertexAttribArray, (Uint index)) \
  F(void, vertex_attrib_pointer, VertexAttribPointer, \
    (Uint index, Int size, Enum type, Boolean normalized, Sizei stride_bytes, const void* offset)) \
  F(void, vertex_attrib_i_pointer, VertexAttribIPointer, (Uint index, Int size, Enum type, Sizei stride_bytes, const void* offset)) \
  F(void, gen_renderbuffers, GenRenderbuffers, (Sizei count, Uint* ids)) \
  F(void, delete_renderbuffers, DeleteRenderbuffers, (Sizei count, const Uint* ids)) \
  F(void, bind_renderbuffer, BindRenderbuffer, (Enum target, Uint id)) \
  F(void, renderbuffer_storage, RenderbufferStorage, (Enum target, Enum format, Sizei width, Sizei height)) \
  F(void, gen_framebuffers, GenFramebuffers, (Sizei count, Uint* ids)) \
  F(void, delete_framebuffers, DeleteFramebuffers, (Sizei count, const Uint* ids)) \
  F(void, bind_framebuffer, BindFramebuffer, (Enum target, Uint id)) \
  F(void, framebuffer_renderbuffer, FramebufferRenderbuffer, (Enum target, Enum attachment, Enum renderbuffer_target, Uint id)) \
  F(void, framebuffer_texture_2d, FramebufferTexture2D, (Enum target, Enum attachment, Enum texture_target, Uint texture, Int level)) \
  F(void, scissor, Scissor, (Int x, Int y, Sizei width, Sizei height)) \
  F(Enum, check_framebuffer_status, CheckFramebufferStatus, (Enum target)) \
  F(void, gen_textures, GenTextures, (Sizei count, Uint* ids)) \
  F(void, delete_textures, DeleteTextures, (Sizei count, const Uint* ids)) \
  F(void, bind_texture, BindTexture, (Enum target, Uint id)) \
  F(void, active_texture, ActiveTexture, (Enum unit)) \
  F(void, tex_image_2d, TexImage2D, \
    (Enum target, Int level, Int internal_format, Sizei width, Sizei height, Int border, Enum format, Enum type, const void* data)) \
  F(void, tex_parameteri, TexParameteri, (Enum target, Enum name, Int value)) \
  F(Uint, create_shader, CreateShader, (Enum stage)) \
  F(void, shader_source, ShaderSource, (Uint shader, Sizei count, const Char* const* strings, const Int* lengths)) \
  F(void, compile_shader, CompileShader, (Uint shader)) \
  F(void, get_shaderiv, GetShaderiv, (Uint shader, Enum name, Int* value)) \
  F(void, get_shader_info_log, GetShaderInfoLog, (Uint shader, Sizei capacity, Sizei* length, Char* log)) \
  F(void, delete_shader, DeleteShader, (Uint shader)) \
  F(Uint, create_program, CreateProgram, ()) \
  F(void, attach_shader, AttachShader, (Uint program, Uint shader)) \
  F(void, link_program, LinkProgram, (Uint program)) \
  F(void, get_programiv, GetProgramiv, (Uint program, Enum name, Int* value)) \
  F(void, get_program_info_log, GetProgramInfoLog, (Uint program, Sizei capacity, Sizei* length, Char* log)) \
  F(void, delete_program, DeleteProgram, (Uint program)) \
  F(void, use_program, UseProgram, (Uint program)) \
  F(Int, get_uniform_location, GetUniformLocation, (Uint program, const Char* name)) \
  F(void, uniform_1i, Uniform1i, (Int location, Int value)) \
  F(void, uniform_1ui, Uniform1ui, (Int location, Uint value)) \
  F(void, uniform_2i, Uniform2i, (Int location, Int x, Int y)) \
  F(void, uniform_2f, Uniform2f, (Int location, Float x, Float y))
// clang-format on

/// The functions of one context's library; every member is set once load_api() has returned.
struct Api {
#define ETALON_GL_DECLARE_FUNCTION(result, member, name, parameters) result(*member) parameters = nullptr;
  ETALON_GL_FUNCTIONS(ETALON_GL_DECLARE_FUNCTION)
#undef ETALON_GL_DECLARE_FUNCTION
};

using ProcAddress = void (*)();

/// Fills the table from "glName" look-ups; UnavailableError naming the first function the library does not have.
[[nodiscard]] Api load_api(const std::function<ProcAddress(const char*)>& get_proc_address);

/// Throws UnavailableError "OpenGL: STEP: GL_OUT_OF_MEMORY" if an error is pending; clears all pending errors.
void check_error(const Api& gl, const std::string& step);

}  // namespace etalon::gpu::gl
