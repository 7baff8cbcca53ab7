#include <openjpeg.h>

#include <algorithm>
#include <cstring>
#include <memory>

#include "core/base/error.h"
#include "tests/bench/simplify_way.h"
#include "tests/bench/texture_bench.h"

namespace etalon::bench {
namespace {

struct Memory {
  std::vector<std::byte> bytes;
  std::size_t at = 0;
};

OPJ_SIZE_T write_some(void* data, OPJ_SIZE_T count, void* user) {
  auto& memory = *static_cast<Memory*>(user);
  memory.bytes.resize(std::max(memory.bytes.size(), memory.at + count));
  std::memcpy(memory.bytes.data() + memory.at, data, count);
  memory.at += count;
  return count;
}
OPJ_SIZE_T read_some(void* data, OPJ_SIZE_T count, void* user) {
  auto& memory = *static_cast<Memory*>(user);
  if (memory.at >= memory.bytes.size()) return static_cast<OPJ_SIZE_T>(-1);
  count = std::min(count, memory.bytes.size() - memory.at);
  std::memcpy(data, memory.bytes.data() + memory.at, count);
  memory.at += count;
  return count;
}
OPJ_OFF_T skip_some(OPJ_OFF_T count, void* user) {
  static_cast<Memory*>(user)->at += static_cast<std::size_t>(count);
  return count;
}
OPJ_BOOL seek_to(OPJ_OFF_T place, void* user) {
  static_cast<Memory*>(user)->at = static_cast<std::size_t>(place);
  return OPJ_TRUE;
}

using Stream = std::unique_ptr<opj_stream_t, decltype(&opj_stream_destroy)>;
using Coder = std::unique_ptr<opj_codec_t, decltype(&opj_destroy_codec)>;
using Picture = std::unique_ptr<opj_image_t, decltype(&opj_image_destroy)>;

Stream stream_of(Memory& memory, bool is_input) {
  Stream stream(opj_stream_create(1 << 20, is_input ? OPJ_TRUE : OPJ_FALSE), opj_stream_destroy);
  opj_stream_set_user_data(stream.get(), &memory, nullptr);
  opj_stream_set_user_data_length(stream.get(), memory.bytes.size());
  opj_stream_set_read_function(stream.get(), read_some);
  opj_stream_set_write_function(stream.get(), write_some);
  opj_stream_set_skip_function(stream.get(), skip_some);
  opj_stream_set_seek_function(stream.get(), seek_to);
  return stream;
}

void require(bool done, const char* what) {
  if (!done) throw InternalError(std::string("OpenJPEG: ") + what + " failed");
}

Picture planes_of(const Image& image) {
  std::vector<opj_image_cmptparm_t> parameters(3);
  for (auto& p : parameters) {
    p.dx = p.dy = 1;
    p.w = static_cast<OPJ_UINT32>(image.width());
    p.h = static_cast<OPJ_UINT32>(image.height());
    p.prec = 8;
  }
  Picture picture(opj_image_create(3, parameters.data(), OPJ_CLRSPC_SRGB), opj_image_destroy);
  picture->x1 = static_cast<OPJ_UINT32>(image.width());
  picture->y1 = static_cast<OPJ_UINT32>(image.height());
  for (std::size_t i = 0; i < image.texel_count(); ++i)
    for (std::size_t c = 0; c < 3; ++c) picture->comps[c].data[i] = std::to_integer<int>(image.bytes()[3 * i + c]);
  return picture;
}

}  // namespace

CodedPicture code_with_openjpeg(const Image& image, wavelet::Kernel kernel, std::size_t max_bytes) {
  const Picture source = planes_of(image);
  opj_cparameters_t parameters;
  opj_set_default_encoder_parameters(&parameters);
  parameters.irreversible = kernel == wavelet::Kernel::irreversible_9_7 ? 1 : 0;
  parameters.tcp_mct = 1;
  parameters.tcp_numlayers = 1;
  parameters.cp_disto_alloc = 1;
  parameters.tcp_rates[0] = static_cast<float>(static_cast<double>(image.bytes().size()) / static_cast<double>(max_bytes));

  CodedPicture coded;
  double start = process_cpu_seconds();
  Memory memory;
  {
    const Coder coder(opj_create_compress(OPJ_CODEC_J2K), opj_destroy_codec);
    require(opj_setup_encoder(coder.get(), &parameters, source.get()) != 0, "setting up the encoder");
    const Stream stream = stream_of(memory, false);
    require(opj_start_compress(coder.get(), source.get(), stream.get()) && opj_encode(coder.get(), stream.get()) &&
                opj_end_compress(coder.get(), stream.get()),
            "encoding");
  }
  coded.encode_seconds = process_cpu_seconds() - start;
  coded.stream = memory.bytes;

  memory.at = 0;
  start = process_cpu_seconds();
  opj_dparameters_t decoding;
  opj_set_default_decoder_parameters(&decoding);
  const Coder decoder(opj_create_decompress(OPJ_CODEC_J2K), opj_destroy_codec);
  require(opj_setup_decoder(decoder.get(), &decoding) != 0, "setting up the decoder");
  const Stream stream = stream_of(memory, true);
  opj_image_t* header = nullptr;
  require(opj_read_header(stream.get(), decoder.get(), &header) != 0, "reading the header");
  const Picture decoded(header, opj_image_destroy);
  require(opj_decode(decoder.get(), stream.get(), decoded.get()) != 0, "decoding");
  coded.picture = Image(image.width(), image.height(), kRgb8);
  for (std::size_t i = 0; i < image.texel_count(); ++i)
    for (std::size_t c = 0; c < 3; ++c)
      coded.picture.bytes()[3 * i + c] = static_cast<std::byte>(std::clamp(decoded->comps[c].data[i], 0, 255));
  coded.decode_seconds = process_cpu_seconds() - start;
  return coded;
}

}  // namespace etalon::bench
