# Outside libraries, all from the distribution; nothing is downloaded at configure time.

find_package(Threads REQUIRED)
find_package(TBB REQUIRED)               # threads: deterministic work split over a well-kept scheduler
find_package(glm REQUIRED)               # small vectors
find_package(fmt REQUIRED)               # gcc 12 has no <format>
find_package(hwy REQUIRED)               # SIMD: one source for SSE, AVX2, AVX-512 and NEON, chosen at run time
find_package(nlohmann_json REQUIRED)     # JSON reports, view files
if(ETALON_IO)
  # Debian's OpenImageIO config names the targets of openimageio-tools, which must be installed too.
  find_package(OpenImageIO REQUIRED)     # PNG, JPEG, TIFF
  find_package(OpenEXR REQUIRED)         # EXR with named half / float / uint32 channels
  find_package(Imath REQUIRED)
endif()
find_package(Boost REQUIRED)             # Boost.Multiprecision (header only): big integers of the judge
