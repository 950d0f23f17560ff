#include "modules/simulation/referee.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
#include <limits>

#include <fmt/format.h>

#include "modules/simulation/algorithm/trajectory_svg.h"
#include "plugins/values/json_writer.h"

namespace runnel {

namespace {

// So many hit and leave points are drawn; a run that has more is not told by its points any more.
constexpr std::size_t kMostPoints = 1000;

// What viewers get of the path: enough for a picture, little enough to be sent again and again.
constexpr std::size_t kMostShown = 1000;
constexpr double kShownSpacing = 0.05;  // m

// By the value of the enumerations.
constexpr std::array<std::string_view, 6> kVerdicts{"stopped",  "reached", "unreachable",
                                                    "mistaken", "timeout", "collision"};
constexpr std::array<std::string_view, 6> kModes{
    "driving to the goal", "following a boundary", "going to the leave point",
    "facing the goal",     "at the goal",          "gave up"};

std::string_view Words(Verdict verdict) { return kVerdicts[static_cast<std::size_t>(verdict)]; }
std::string_view Words(PlannerMode mode) { return kModes[static_cast<std::size_t>(mode)]; }

PathMode LookOf(PlannerMode mode) {
  using enum PlannerMode;
  if (mode == kFollowingBoundary || mode == kUnreachable) return PathMode::kFollowingWall;
  return mode == kGoingToLeavePoint || mode == kFacingGoal ? PathMode::kGoingToLeavePoint : PathMode::kDrivingToGoal;
}

/// How it is told to programs that compare runs.
struct Ending {
  std::string_view outcome;
  std::string_view remark = {};
};
Ending EndingOf(Verdict verdict) {
  if (verdict == Verdict::kMistaken) {
    return {"error", "the planner says that it is at the goal, and is not"};
  }
  if (verdict == Verdict::kRunning) return {"error", "the run was ended before it was over"};
  return {Words(verdict)};
}

// What is said of it then.
Result<std::string> WriteTo(const StaticParameter<FilePath>& parameter, const std::string& content,
                            const std::string& what, const std::string& told) {
  std::ofstream file(parameter.Get().path());
  file << content;
  file.close();
  if (file) return told + parameter.Get().text;
  return Error{.message = what + " '" + parameter.Get().text + "' could not be written", .path = parameter.path()};
}

void AppendNumber(double number, std::string& json) {
  AppendJsonNumber(std::isfinite(number) ? number : std::numeric_limits<double>::quiet_NaN(), json);
}

void AppendPlace(Point2 point, std::string& json) {
  JsonArray place(json);
  AppendNumber(point.x, place.Next());
  AppendNumber(point.y, place.Next());
}

void AppendSample(const PathSample& sample, std::string& json) {
  JsonArray list(json);
  for (const double each : {sample.time, sample.position.x, sample.position.y, sample.heading}) {
    // To the micrometre, -radian or -second: more digits would say nothing and make a big file.
    AppendNumber(std::round(each * 1e6) / 1e6 + 0.0, list.Next());
  }
}

}  // namespace

/// What the program that runs the application is told.
class Referee::Monitor final : public RunMonitor {
 public:
  explicit Monitor(Referee& referee) : referee_(referee) {}

  std::string Progress() const override {
    const Standing now = referee_.LastStanding();
    return fmt::format("{:6.2f} m to the goal, {}", now.distance_to_goal, Words(now.mode));
  }
  std::optional<RunOutcome> Outcome() const override {
    const Standing end = referee_.LastStanding();
    if (end.verdict == Verdict::kRunning) return std::nullopt;
    return RunOutcome{.verdict = std::string(Words(end.verdict)),
                      .summary = fmt::format("path {:.2f} m, time {:.2f} s", end.path_length, end.elapsed),
                      .success = referee_.IsSuccess(end.verdict)};
  }
  Result<std::string> Finish() override { return referee_.Finish(); }

 private:
  Referee& referee_;
};

Referee::Referee(const Placement& placement) : Module(placement), shown_path_(kMostShown, kShownSpacing) {
  Annotate<RunMonitor>(std::make_unique<Monitor>(*this));
  hit_points_.reserve(kMostPoints);
  leave_points_.reserve(kMostPoints);
}

Result<void> Referee::Prepare() {
  driven_path.PrepareBuffers([](Path2& buffer) { buffer.points.reserve(kMostShown); });
  if (auto checked = CheckFolder(picture, "the picture"); !checked) return checked;
  return CheckFolder(result, "the result");
}

Result<void> Referee::CheckFolder(const StaticParameter<FilePath>& file, std::string_view what) const {
  if (file.Get().empty()) return {};
  const auto folder = std::filesystem::absolute(file.Get().path()).parent_path();
  if (!std::filesystem::is_directory(folder)) {
    return Error{.message = "there is no folder '" + folder.string() + "' for " + std::string(what),
                 .path = file.path()};
  }
  return {};
}

void Referee::Update() {
  const auto at = pose.Read();
  const auto there = goal.Read();
  if (!begin_) begin_ = now();
  if (standing_.verdict != Verdict::kRunning) return;
  ++cycles_;
  if (!at.is_new() || !there) return CheckTimeLimit();
  if (const auto said = status.Read()) planner_ = *said;
  if (const auto touch = contact.Read()) touched_ = touched_ || touch->is_touching;
  Record(*at);
  standing_ = {.mode = planner_.mode,
               .verdict = VerdictAt(*at, *there),
               .distance_to_goal = Distance(Position(*at), *there),
               .path_length = path_.length(),
               .elapsed = ToSeconds(now() - *begin_)};
  shown_.Publish(standing_, now().time_since_epoch().count());
}

// The world may have fallen silent; the time limit holds all the same.
void Referee::CheckTimeLimit() {
  if (!IsTimeUp()) return;
  standing_.verdict = Verdict::kTimeout;
  standing_.elapsed = ToSeconds(now() - *begin_);
  shown_.Publish(standing_, now().time_since_epoch().count());
}

bool Referee::IsTimeUp() const { return now() - *begin_ >= FromSeconds(time_limit.Get()); }

void Referee::Record(const Pose2& at) {
  const PathSample sample{Position(at), LookOf(planner_.mode), at.heading, ToSeconds(now() - *begin_)};
  path_.Add(sample);
  ShowPath(sample);
  end_ = at;
  RecordPoints();
}

void Referee::ShowPath(const PathSample& sample) {
  if (!shown_path_.Add(sample)) return;
  auto loan = driven_path.Loan();
  if (!loan) return;  // viewers hold all that there are; the next one has this point, too
  shown_path_.CopyPositions(loan->points);
  driven_path.Publish(std::move(loan));
}

void Referee::RecordPoints() {
  const auto copy = [](const std::vector<Point2>& from, std::vector<Point2>& to) {
    const auto count = static_cast<std::ptrdiff_t>(std::min(from.size(), kMostPoints));
    to.assign(from.begin(), from.begin() + count);  // within what has been reserved
  };
  if (const auto all = points.Read(); all.is_new()) {
    has_points_ = true;
    copy(all->hits, hit_points_);
    copy(all->leaves, leave_points_);
  }
  if (has_points_) return;
  if (planner_.hits > hit_points_.size() && hit_points_.size() < kMostPoints) {
    hit_points_.push_back(planner_.hit_point);
  }
  if (planner_.leaves > leave_points_.size() && leave_points_.size() < kMostPoints) {
    leave_points_.push_back(planner_.leave_point);
  }
}

Verdict Referee::VerdictAt(const Pose2& at, const Point2& there) const {
  if (touched_ && touch_is_collision.Get()) return Verdict::kCollision;
  if (planner_.mode == PlannerMode::kUnreachable) return Verdict::kUnreachable;
  if (planner_.mode == PlannerMode::kReached) {
    const bool is_there = Distance(Position(at), there) <= goal_tolerance.Get();
    return is_there ? Verdict::kReached : Verdict::kMistaken;
  }
  return IsTimeUp() ? Verdict::kTimeout : Verdict::kRunning;
}

Referee::Standing Referee::LastStanding() const {
  Standing standing;
  Publication publication;
  shown_.Read(standing, publication);  // as constructed before the first cycle
  return standing;
}

bool Referee::IsSuccess(Verdict verdict) const {
  const Expectation wanted = expected.Get();
  return (verdict == Verdict::kReached && wanted != Expectation::kUnreachable) ||
         (verdict == Verdict::kUnreachable && wanted != Expectation::kReached);
}

Result<std::string> Referee::Finish() const {
  const auto drawn = DrawPicture();
  const auto written = WriteResult();
  if (!drawn || !written) return drawn ? written : drawn;
  return *drawn + (drawn->empty() || written->empty() ? "" : "\n") + *written;
}

Result<std::string> Referee::DrawPicture() const {
  const auto seen = scene.Peek();
  if (picture.Get().empty() || !seen) return std::string();
  const bool is_good = IsSuccess(standing_.verdict);
  const Trajectory trajectory{.path = path_.Samples(),
                              .hits = hit_points_,
                              .leaves = leave_points_,
                              .end = end_,
                              .robot_radius = seen->robot_radius,
                              .verdict = std::string(Words(standing_.verdict)),
                              .tone = is_good                                  ? VerdictTone::kGood
                                      : standing_.verdict == Verdict::kRunning ? VerdictTone::kNeutral
                                                                               : VerdictTone::kBad,
                              .duration = standing_.elapsed,
                              .length = path_.length()};
  World world = *seen->world;
  if (const auto there = goal.Peek()) world.goal = *there;
  return WriteTo(picture, TrajectorySvg(world, trajectory), "the picture", "the path is drawn in ");
}

Result<std::string> Referee::WriteResult() const {
  if (result.Get().empty()) return std::string();
  const auto seen = scene.Peek();
  const Ending ending = EndingOf(standing_.verdict);
  const RunResult all{.outcome = std::string(ending.outcome),
                      .remark = std::string(ending.remark),
                      .path_length = path_.length(),
                      .simulated_time = standing_.elapsed,
                      .cycles = cycles_,
                      .robot_radius = seen ? seen->robot_radius : 0.0,
                      .hits = hit_points_,
                      .leaves = leave_points_,
                      .path = ThinnedPath(path_.Samples(), path_step.Get())};
  return WriteTo(result, JsonOf(all), "the result", "the result is in ");
}

std::string JsonOf(const RunResult& result) {
  return JsonObjectText([&](JsonObject& object) {
           object.Add("outcome", result.outcome).Add("remark", result.remark);
           AppendNumber(result.path_length, object.Key("path_length_m"));
           AppendNumber(result.simulated_time, object.Key("sim_time_s"));
           object.Add("cycles", result.cycles);
           AppendNumber(result.robot_radius, object.Key("robot_radius_m"));
           AppendList(result.hits, object.Key("hits"), AppendPlace);
           AppendList(result.leaves, object.Key("leaves"), AppendPlace);
           AppendList(result.path, object.Key("path"), AppendSample);
           AppendList(result.path, object.Key("modes"), [](const PathSample& sample, std::string& json) {
             AppendJsonNumber(static_cast<std::int64_t>(sample.mode), json);
           });
         }) +
         "\n";
}

}  // namespace runnel
