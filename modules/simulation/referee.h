#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/lockfree/latest_value.h"
#include "core/module/module.h"
#include "core/module/run_monitor.h"
#include "core/port/input.h"
#include "core/port/output.h"
#include "modules/simulation/algorithm/path_record.h"
#include "modules/simulation/scene.h"
#include "modules/types/measurements.h"
#include "modules/types/planner_status.h"
#include "modules/types/pose.h"
#include "plugins/parameters/file_path.h"
#include "plugins/parameters/parameter.h"
#include "plugins/parameters/prepares_anywhere.h"

namespace runnel {

/// How a run can end. Only the referee, who knows the truth, says so.
enum class Verdict : std::uint8_t {
  kRunning,
  kReached,      ///< the planner says so, and it is true
  kUnreachable,  ///< the planner says so
  kMistaken,     ///< the planner says it is there, and is not
  kTimeout,
  kCollision,
};

/// What the application's author takes for a success.
enum class Expectation : std::uint8_t { kReached, kUnreachable, kEither };

inline void Describe(TypeBuilder<Expectation>& type) {
  type.Name("Expectation").Values<Expectation::kReached, Expectation::kUnreachable, Expectation::kEither>();
}

/// Watches the robot as it really moves and the planner as it speaks, and judges: reached,
/// unreachable, timeout, collision. Measures path and time, and draws the path into a picture of
/// the world and writes the result into a file when the run is over. Runs in the thread of the world, or it may miss a short touch.
class Referee final : public Module, public PreparesAnywhere {
 public:
  explicit Referee(const Placement& placement);

  Input<Scene> scene{this, "scene", {.description = "what the picture shows", .required = true}};
  Input<Pose2> pose{this, "pose", {.description = "where the robot really is", .required = true}};
  Input<Point2> goal{this, "goal", {.description = "where it is to go", .required = true}};
  Input<Contact> contact{this, "contact", {.description = "what it touches", .required = true}};
  Input<PlannerStatus> status{this, "status", {.description = "what the planner says", .required = true}};
  Input<HitAndLeavePoints> points{
      this, "points", {.description = "all hit and leave points; unconnected, those that the status has had"}};

  Output<Path2> driven_path{this,
                            "path",
                            {.description = "where the robot went; the longer it is, the coarser",
                             .pool = {.buffers = 4, .may_grow = false}}};

  StaticParameter<double> time_limit{
      this,
      "time_limit",
      {.default_value = 1800, .bounds = {0.0, 1e6}, .unit = "s", .description = "after which the run has failed"}};
  StaticParameter<double> goal_tolerance{
      this,
      "goal_tolerance",
      {.default_value = 0.15, .bounds = {0.0, 10.0}, .unit = "m", .description = "how near is near enough, really"}};
  StaticParameter<Expectation> expected{
      this, "expected", {.default_value = Expectation::kEither, .description = "which verdicts count as a success"}};
  StaticParameter<bool> touch_is_collision{
      this,
      "touch_is_collision",
      {.default_value = true,
       .description = "whether touching something ends the run; not so for a robot that feels its way"}};
  StaticParameter<FilePath> picture{
      this, "picture", {.description = "the SVG file to draw the path into; empty for none"}};
  StaticParameter<FilePath> result{
      this, "result", {.description = "the JSON file to write the result into; empty for none"}};
  StaticParameter<double> path_step{this,
                                    "path_step",
                                    {.default_value = 0.1,
                                     .bounds = {0.0, 1000.0},
                                     .unit = "m",
                                     .description = "from one point to the next of the path in the result"}};

 private:
  class Monitor;
  friend class Monitor;

  /// What the program that runs the application sees, from whichever thread.
  struct Standing {
    PlannerMode mode = PlannerMode::kMotionToGoal;
    Verdict verdict = Verdict::kRunning;
    double distance_to_goal = 0.0;  ///< m, of the real pose
    double path_length = 0.0;       ///< m
    double elapsed = 0.0;           ///< s
  };

  Result<void> Prepare() override;
  void Update() override;
  void CheckTimeLimit();
  [[nodiscard]] bool IsTimeUp() const;
  void Record(const Pose2& at);
  void RecordPoints();
  void ShowPath(const PathSample& sample);
  [[nodiscard]] Verdict VerdictAt(const Pose2& at, const Point2& there) const;
  [[nodiscard]] Standing LastStanding() const;
  [[nodiscard]] bool IsSuccess(Verdict verdict) const;
  [[nodiscard]] Result<void> CheckFolder(const StaticParameter<FilePath>& file, std::string_view what) const;
  [[nodiscard]] Result<std::string> Finish() const;
  [[nodiscard]] Result<std::string> DrawPicture() const;
  [[nodiscard]] Result<std::string> WriteResult() const;

  PlannerStatus planner_;
  bool has_points_ = false;
  bool touched_ = false;
  PathRecord path_;
  PathRecord shown_path_;
  std::vector<Point2> hit_points_;
  std::vector<Point2> leave_points_;
  std::optional<Pose2> end_;
  std::optional<Time> begin_;
  std::uint64_t cycles_ = 0;
  Standing standing_;
  LatestValue<Standing> shown_;
};

/// The result as one JSON object: outcome, remark, path_length_m, sim_time_s, cycles,
/// robot_radius_m, hits and leaves (lists of [x, y]), path (list of [t, x, y, heading]) and modes
/// (of each point of the path: 0 driving to the goal, 1 following a wall, 2 going to the leave
/// point). Numbers of the path are rounded to six places, others lose no bit; what is not finite is null.
[[nodiscard]] std::string JsonOf(const RunResult& result);

}  // namespace runnel
