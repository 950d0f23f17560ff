// What it takes to turn a value into octets of the wire and back: a picture of 1920 x 1080 x 3 octets, beside memcpy of
// as many, and a scan of 720 ranges.
#include <cstring>
#include <vector>

#include <benchmark/benchmark.h>

#include "modules/types/measurements.h"
#include "plugins/cdr_values/cdr_values.h"

namespace runnel {
namespace {

Image Picture() {
  Image image{.width = 1920, .height = 1080, .encoding = "rgb8", .row_stride = 5760, .data = {}};
  image.data.resize(std::size_t{image.row_stride} * image.height, 7);
  return image;
}

RangeScan Scan() {
  RangeScan scan;
  scan.ranges.resize(720, 2.5F);
  return scan;
}

void CopyPicture(benchmark::State& state) {
  const Image image = Picture();
  std::vector<std::uint8_t> copy(image.data.size());
  for (auto each : state) {
    std::memcpy(copy.data(), image.data.data(), copy.size());
    benchmark::ClobberMemory();
  }
}

template <typename T>
void Write(benchmark::State& state, const T& value) {
  std::vector<std::byte> octets;
  for (auto each : state) {
    WriteCdr(TypeOf<T>(), &value, octets);
    benchmark::ClobberMemory();
  }
}

template <typename T>
void Read(benchmark::State& state, const T& value) {
  std::vector<std::byte> octets;
  WriteCdr(TypeOf<T>(), &value, octets);
  T read{};
  for (auto each : state) {
    if (!ReadCdr(TypeOf<T>(), octets, &read)) state.SkipWithError("it cannot be read");
    benchmark::ClobberMemory();
  }
}

BENCHMARK(CopyPicture)->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(Write, picture, Picture())->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(Read, picture, Picture())->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(Write, scan, Scan())->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(Read, scan, Scan())->Unit(benchmark::kMicrosecond);

}  // namespace
}  // namespace runnel
