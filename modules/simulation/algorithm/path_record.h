#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "modules/types/algorithm/pose.h"

namespace runnel {

/// What a robot that finds its way round obstacles was about at a moment; it colours the path.
enum class PathMode { kDrivingToGoal, kFollowingWall, kGoingToLeavePoint };

struct PathSample {
  Point2 position;
  PathMode mode = PathMode::kDrivingToGoal;
  double heading = 0.0;  ///< rad
  double time = 0.0;     ///< s since the run began
};

/// Remembers a path of any length in memory of a fixed size: points nearer to the last one than the
/// spacing are left out, and whenever the memory is full, every other point is, and the spacing
/// doubled. A change of mode is always kept until then. The length is summed up over all points.
///
/// Allocation: in the constructor only. Threads: not thread-safe.
class PathRecord {
 public:
  explicit PathRecord(std::size_t capacity = 16384, double spacing = 0.02)
      : capacity_(capacity < 4 ? 4 : capacity), spacing_(spacing) {
    samples_.reserve(capacity_);
  }

  /// Whether the point was kept for good, not only as the last one.
  bool Add(const PathSample& sample) {
    if (samples_.empty()) {
      last_ = sample;
      samples_.push_back(sample);
      return true;
    }
    length_ += Distance(last_.position, sample.position);
    last_ = sample;
    if (sample.mode == samples_.back().mode && Distance(samples_.back().position, sample.position) < spacing_) {
      return false;
    }
    if (samples_.size() == capacity_) Thin();
    samples_.push_back(sample);
    return true;
  }

  /// Whole, with the very last point.
  [[nodiscard]] std::vector<PathSample> Samples() const {
    std::vector<PathSample> samples = samples_;
    if (!samples.empty()) samples.push_back(last_);
    return samples;
  }
  /// The points that were kept, at most the capacity.
  void CopyPositions(std::vector<Point2>& to) const {
    to.clear();
    for (const PathSample& sample : samples_) to.push_back(sample.position);
  }
  [[nodiscard]] double length() const noexcept { return length_; }  ///< m

 private:
  void Thin() {
    std::size_t kept = 0;
    for (std::size_t i = 0; i < samples_.size(); i += 2) samples_[kept++] = samples_[i];
    samples_.resize(kept);
    spacing_ *= 2;
  }

  const std::size_t capacity_;
  double spacing_;  // m
  double length_ = 0.0;
  PathSample last_;
  std::vector<PathSample> samples_;
};

/// What is left of a run when it is over, for programs that compare runs. In m, rad and s, in the
/// world's frame.
struct RunResult {
  std::string outcome = {};         ///< "reached", "unreachable", "timeout", "collision", "error"
  std::string remark = {};          ///< what an error was; may be empty
  double path_length = 0.0;         ///< m
  double simulated_time = 0.0;      ///< s
  std::uint64_t cycles = 0;         ///< of control
  double robot_radius = 0.0;        ///< m
  std::vector<Point2> hits = {};    ///< where obstacles were met, in the order of time
  std::vector<Point2> leaves = {};  ///< where they were left again
  std::vector<PathSample> path = {};
};

/// Leaves out samples that are nearer than `step` (m) to the last one kept; the first and the last
/// stay. A step of 0 leaves all.
[[nodiscard]] inline std::vector<PathSample> ThinnedPath(const std::vector<PathSample>& path, double step) {
  std::vector<PathSample> thinned;
  for (const PathSample& sample : path) {
    if (thinned.empty() || Distance(thinned.back().position, sample.position) >= step) {
      thinned.push_back(sample);
    }
  }
  if (!path.empty() && thinned.back().time < path.back().time) thinned.push_back(path.back());
  return thinned;
}

}  // namespace runnel
