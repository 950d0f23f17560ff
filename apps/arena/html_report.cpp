#include <algorithm>
#include <array>
#include <string_view>
#include <vector>

#include <fmt/format.h>

#include "apps/arena/application_text.h"
#include "apps/arena/report.h"
#include "core/base/characters.h"
#include "modules/simulation/algorithm/outline.h"
#include "modules/simulation/algorithm/trajectory_svg.h"
#include "modules/simulation/algorithm/world_geometry.h"
#include "modules/types/algorithm/svg_writer.h"

namespace runnel::arena {

namespace {

constexpr double kAir = 0.6;  // m, round all that is shown

// The y axis is turned over here rather than by a transform, so that a page can be read.
Point2 OnPage(Point2 point) { return {point.x, -point.y}; }

std::vector<Point2> OnPage(std::vector<Point2> points) {
  for (Point2& point : points) point = OnPage(point);
  return points;
}

std::string Look(const char* name) { return std::string("class=\"") + name + "\""; }

void DrawObstacles(const World& world, const Extent& view, SvgWriter& svg) {
  const auto draw = [&](std::vector<Ring> rings) {
    for (Ring& ring : rings) ring = OnPage(std::move(ring));
    svg.Rings(rings, Look("solid"));
  };
  if (world.bounds) {
    draw({{view.low, {view.high.x, view.low.y}, view.high, {view.low.x, view.high.y}}, *world.bounds});
  }
  for (const PolygonObstacle& polygon : world.polygons) {
    std::vector<Ring> rings{polygon.outline};
    rings.insert(rings.end(), polygon.holes.begin(), polygon.holes.end());
    draw(std::move(rings));
  }
  for (const BoxObstacle& box : world.boxes) draw({CornersOf(box)});
  for (const CylinderObstacle& cylinder : world.cylinders) {
    svg.Circle(OnPage(cylinder.centre), cylinder.radius, Look("solid"));
  }
  for (const WallObstacle& wall : world.walls) {
    svg.Polyline(OnPage(wall.points), Look("wall") + " stroke-width=\"" + Fixed(wall.thickness, 3) + "\"");
  }
}

std::string ViewBoxText(const Extent& view) {
  const Point2 size = view.high - view.low;
  return "viewBox=\"" + Fixed(view.low.x, 2) + " " + Fixed(-view.high.y, 2) + " " + Fixed(size.x, 2) + " " +
         Fixed(size.y, 2) + "\"";
}

constexpr std::array<const char*, 3> kLooks{"goal-bound", "following", "returning"};

void DrawPath(const std::vector<PathSample>& path, SvgWriter& svg) {
  for (std::size_t first = 0; first < path.size();) {
    std::size_t end = first;
    std::vector<Point2> line;
    while (end < path.size() && path[end].mode == path[first].mode) {
      line.push_back(OnPage(path[end++].position));
    }
    if (end < path.size()) line.push_back(OnPage(path[end].position));
    svg.Polyline(line, Look(kLooks[static_cast<std::size_t>(path[first].mode)]));
    first = end;
  }
}

// The world's obstacles, start, goal and shortest path, as a <symbol> of this id. Drawn in m, y up; colours come from the
// classes of the page.
std::string WorldSymbol(const std::string& id, const Course& course, const Extent& view) {
  SvgWriter svg;
  DrawObstacles(course.world, view, svg);
  if (course.shortest) svg.Polyline(OnPage(course.shortest->points), Look("shortest"));
  const double mark = 0.012 * Norm(view.high - view.low);
  svg.Circle(OnPage(Position(course.world.start)), mark, Look("start"));
  svg.Circle(OnPage(course.world.goal), mark, Look("goal"));
  return "<symbol id=\"" + id + "\" " + ViewBoxText(view) + ">" + svg.Take() + "</symbol>\n";
}

// One run over the world: an <svg> that uses the symbol.
std::string RunDrawing(const std::string& world_id, const RunRecord& record, const Extent& view) {
  const double mark = 0.009 * Norm(view.high - view.low);
  const Point2 size = view.high - view.low;
  SvgWriter svg;
  DrawPath(record.result.path, svg);
  for (const Point2 hit : record.result.hits) svg.Circle(OnPage(hit), mark, Look("hit"));
  for (const Point2 leave : record.result.leaves) svg.Circle(OnPage(leave), mark, Look("leave"));
  return "<svg role=\"img\" aria-label=\"" + EscapedMarkup(TextOf(record.key)) + "\" " + ViewBoxText(view) +
         "><use href=\"#" + world_id + "\" x=\"" + Fixed(view.low.x, 3) + "\" y=\"" + Fixed(-view.high.y, 3) +
         "\" width=\"" + Fixed(size.x, 3) + "\" height=\"" + Fixed(size.y, 3) + "\"/>" + svg.Close();
}

// `titles`: of the columns; those with a '#' in front hold numbers.
std::string Table(const std::vector<std::string_view>& titles, const std::string& rows) {
  std::string text = "<div class=\"scroll\"><table><thead><tr>";
  for (std::string_view title : titles) {
    const bool is_number = title.front() == '#';
    if (is_number) title.remove_prefix(1);
    text += fmt::format("<th scope=\"col\"{}><button type=\"button\">{}</button></th>",
                        is_number ? " class=\"number\"" : "", title);
  }
  return text + "</tr></thead><tbody>\n" + rows + "</tbody></table></div>\n";
}

std::string Cell(const std::string& text) { return "<td>" + EscapedMarkup(text) + "</td>"; }
std::string NumberCell(const std::string& text) { return "<td class=\"number\">" + text + "</td>"; }
std::string NumberCell(const std::optional<double>& number, int digits) {
  return NumberCell(number ? Fixed(*number, digits) : "–");
}

std::string OutcomeText(const Row& row) {
  return std::string("<span class=\"") + (row.is_right ? "good" : "bad") + "\">" +
         EscapedMarkup(row.record->result.outcome) +
         (row.is_right                   ? ""
          : MayFailByDesign(*row.record) ? " (by design: no guarantee)"
                                         : " (wrong)") +
         "</span>";
}

std::string SummaryTable(const std::vector<Row>& rows) {
  std::string text;
  for (const Summary& summary : SummariesOf(rows)) {
    text += "<tr>" + Cell(summary.variant) + NumberCell(std::to_string(summary.runs)) +
            NumberCell(std::to_string(summary.right)) +
            NumberCell(100.0 * static_cast<double>(summary.right) / static_cast<double>(summary.runs), 1) +
            NumberCell(summary.mean_ratio, 3) + NumberCell(summary.path_length, 1) + "</tr>\n";
  }
  return Table({"variant", "#runs", "#right", "#success / %", "#mean ratio", "#all paths / m"}, text);
}

std::string RunTable(const std::vector<Row>& rows) {
  std::string text;
  for (const Row& row : rows) {
    const RunKey& key = row.record->key;
    const RunResult& result = row.record->result;
    text += "<tr>" + Cell(key.world) + Cell(key.variant) + Cell(key.sensor) + Cell(key.direction) +
            NumberCell(std::to_string(key.seed)) + "<td>" + OutcomeText(row) + "</td>" +
            NumberCell(result.path_length, 2) + NumberCell(row.ratio, 2) + NumberCell(row.bound, 2) +
            NumberCell(result.simulated_time, 1) + NumberCell(std::to_string(result.hits.size())) +
            Cell(result.remark) + "</tr>\n";
  }
  return Table({"world", "variant", "sensor", "direction", "#seed", "outcome", "#length / m", "#ratio", "#bound / m",
                "#time / s", "#hits", "remark"},
               text);
}

std::string Figure(const Row& row, const std::string& world_id, const Extent& view) {
  const RunKey& key = row.record->key;
  std::string caption = "<b>" + EscapedMarkup(key.variant) + "</b> " + EscapedMarkup(key.sensor) + ", " +
                        EscapedMarkup(key.direction) + ", seed " + std::to_string(key.seed) + "<br>" +
                        OutcomeText(row) + ", " + Fixed(row.record->result.path_length, 2) + " m";
  if (row.ratio) caption += ", " + Fixed(*row.ratio, 2) + " × shortest";
  return std::string("<figure") + (row.is_right ? "" : " class=\"wrong\"") + ">" +
         RunDrawing(world_id, *row.record, view) + "<figcaption>" + caption + "</figcaption></figure>\n";
}

std::string WorldSection(const Course& course, std::size_t number, const std::vector<Row>& rows) {
  const std::string id = "w" + std::to_string(number);
  const Extent extent = ExtentOf(course.world);
  Extent view{extent.low - Point2{kAir, kAir}, extent.high + Point2{kAir, kAir}};
  for (const Row& row : rows) {
    if (row.course != &course) continue;
    for (const PathSample& sample : row.record->result.path) view.Include(sample.position, 0.3);
  }
  std::string text =
      "<h2>" + EscapedMarkup(course.name) + "</h2>\n<p>" +
      (course.shortest ? "Shortest path " + Fixed(course.shortest->length, 2) + " m." : "The goal cannot be reached.") +
      "</p>\n<svg style=\"display:none\">" + WorldSymbol(id, course, view) + "</svg>\n<div class=\"runs\">\n";
  for (const Row& row : rows) {
    if (row.course == &course) text += Figure(row, id, view);
  }
  return text + "</div>\n";
}

constexpr std::string_view kKey =
    "<p class=\"key\"><span><i style=\"background:var(--goal-bound)\"></i>driving to the "
    "goal</span>"
    "<span><i style=\"background:var(--following)\"></i>following a boundary</span>"
    "<span><i style=\"background:var(--returning)\"></i>going to the leave point</span>"
    "<span><i style=\"background:var(--faint)\"></i>shortest path (dashed)</span>"
    "<span><i class=\"dot\" style=\"background:var(--hit)\"></i>hit point</span>"
    "<span><i class=\"dot\" style=\"background:var(--leave)\"></i>leave point</span>"
    "<span><i class=\"dot\" style=\"background:var(--ink)\"></i>start</span>"
    "<span><i class=\"dot\" style=\"background:var(--good)\"></i>goal</span></p>\n";

}  // namespace

std::string HtmlReport(const Matrix& matrix, const std::vector<RunRecord>& records, const RunSettings& settings) {
  const std::vector<Row> rows = RowsOf(matrix, records);
  std::string text =
      "<!doctype html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
      "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n"
      "<title>Runnel arena</title>\n<style>" +
      std::string(kPageStyle) + "</style>\n</head>\n<body>\n<h1>Arena</h1>\n";
  text += "<p>" + std::to_string(records.size()) + " runs; noise of the ranges " + Fixed(settings.noise, 3) +
          " m, safe distance " + Fixed(settings.safe_distance, 2) + " m; " + TextOf(SpeedOf(records)) + ".</p>\n";
  text +=
      "<p>A ratio is the length of a path to that of the shortest one for the robot's centre; "
      "a bound is what has been proved for a point that follows boundaries exactly.</p>\n";
  text += "<h2>Variants</h2>\n" + SummaryTable(rows) + std::string(kKey);
  for (std::size_t i = 0; i < matrix.courses.size(); ++i) {
    const Course& course = matrix.courses[i];
    if (std::ranges::find(rows, &course, &Row::course) != rows.end()) {
      text += WorldSection(course, i, rows);
    }
  }
  text += "<h2>All runs</h2>\n" + RunTable(rows);
  return text + "<script>" + std::string(kPageScript) + "</script>\n</body>\n</html>\n";
}

Result<void> WritePicture(const std::filesystem::path& folder, const Course& course, const RunRecord& record) {
  const RunResult& result = record.result;
  Trajectory trajectory{.path = result.path,
                        .hits = result.hits,
                        .leaves = result.leaves,
                        .verdict = result.outcome,
                        .tone = course.IsRight(result.outcome) ? VerdictTone::kGood : VerdictTone::kBad,
                        .duration = result.simulated_time,
                        .length = result.path_length};
  if (result.robot_radius > 0.0) trajectory.robot_radius = result.robot_radius;
  if (!result.path.empty()) {
    const PathSample& last = result.path.back();
    trajectory.end = Pose2{last.position.x, last.position.y, last.heading};
  }
  World world = course.world;
  world.name = record.key.world + " · " + record.key.variant + " · " + record.key.sensor;
  return WriteFile(folder / (FileNameOf(record.key) + ".svg"), TrajectorySvg(world, trajectory));
}

}  // namespace runnel::arena
