#pragma once

#include "core/module/module.h"
#include "core/port/input.h"
#include "core/port/output.h"
#include "modules/sensors/algorithm/median_filter.h"
#include "modules/types/measurements.h"
#include "plugins/parameters/parameter.h"

namespace runnel {

/// Takes single wrong rays out of laser scans by a median over neighbouring rays.
class ScanFilter final : public Module {
 public:
  using Module::Module;

  Input<RangeScan> raw{
      this, "raw", {.description = "scans as measured", .required = true, .ageing = Ageing::kPassedOn}};
  Output<RangeScan> filtered{this, "filtered", {.description = "the same without single outliers"}};

  Parameter<std::uint32_t> reach{
      this,
      "reach",
      {.default_value = 1, .bounds = {0, kLargestReach}, .description = "how many rays on either side are looked at"}};

 private:
  /// Allocates when the first scan comes, and whenever one is larger than all before.
  void MakeRoomFor(std::size_t rays) {
    if (rays <= room_) return;
    room_ = rays;
    filtered.PrepareBuffers([rays](RangeScan& buffer) { buffer.ranges.reserve(rays); });
  }

  void Update() override {
    const auto scan = raw.Read();
    if (!scan.is_new()) return;
    MakeRoomFor(scan->ranges.size());
    auto loan = filtered.Loan();
    *loan = *scan;  // into memory that the buffer has kept
    MedianFilter(scan->ranges, reach.Get(), loan->ranges);
    filtered.Publish(std::move(loan), scan.timestamp());
  }

  std::size_t room_ = 0;  // rays
};

}  // namespace runnel
