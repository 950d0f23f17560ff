#pragma once

#include <string>

#include "bench/report/measurement.h"

namespace runnel::bench {

/// Frameworks that do not fit into this program, measured with the same workloads on another machine,
/// beside Runnel here: each divided by a yardstick of its own run, which both runs have (f, a bare
/// queue, a seqlock, filling alone). Rough: such ratios carry over from machine to machine by a factor of two at best.
/// Empty if nothing of it was measured.
[[nodiscard]] std::string PeerTable(const Results& results);

}  // namespace runnel::bench
