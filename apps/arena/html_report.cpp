#include <algorithm>
#include <vector>

#include <fmt/format.h>

#include "apps/arena/application_text.h"
#include "apps/arena/report.h"
#include "core/base/characters.h"
#include "modules/simulation/algorithm/trajectory_svg.h"

namespace runnel::arena {

namespace {

// The picture that the referee of the run draws, with the shortest path.
std::string Picture(const Course& course, const RunRecord& record) {
  const RunResult& result = record.result;
  Trajectory trajectory{.path = result.path,
                        .hits = result.hits,
                        .leaves = result.leaves,
                        .verdict = result.outcome,
                        .tone = course.IsRight(result.outcome) ? VerdictTone::kGood : VerdictTone::kBad,
                        .duration = result.simulated_time,
                        .length = result.path_length};
  if (course.shortest) trajectory.shortest = course.shortest->points;
  if (result.robot_radius > 0.0) trajectory.robot_radius = result.robot_radius;
  if (!result.path.empty()) {
    const PathSample& last = result.path.back();
    trajectory.end = Pose2{last.position.x, last.position.y, last.heading};
  }
  World world = course.world;
  world.name = record.key.world + " · " + record.key.variant + " · " + record.key.sensor;
  return TrajectorySvg(world, trajectory);
}

// `rows`: of the lines, if they are runs.
std::string HtmlTable(const TextTable& table, const std::vector<Row>& rows = {}) {
  std::string text = "<div class=\"scroll\"><table><thead><tr>";
  const auto look = [&](std::size_t i) { return table.IsNumber(i) ? " class=\"number\"" : ""; };
  for (std::size_t i = 0; i < table.titles.size(); ++i) {
    text += fmt::format("<th scope=\"col\"{}><button type=\"button\">{}</button></th>", look(i), table.titles[i]);
  }
  text += "</tr></thead><tbody>\n";
  for (std::size_t line = 0; line < table.lines.size(); ++line) {
    text += line < rows.size() && !rows[line].is_right ? "<tr class=\"bad\">" : "<tr>";
    for (std::size_t i = 0; i < table.lines[line].size(); ++i)
      text += fmt::format("<td{}>{}</td>", look(i), EscapedMarkup(table.lines[line][i]));
    text += "</tr>\n";
  }
  return text + "</tbody></table></div>\n";
}

std::string OutcomeText(const Row& row) {
  return std::string("<span class=\"") + (row.is_right ? "good" : "bad") + "\">" +
         EscapedMarkup(row.record->result.outcome) + "</span> " + EscapedMarkup(RemarkOf(row));
}

std::string Figure(const Row& row) {
  std::string caption = EscapedMarkup(TextOf(row.record->key)) + "<br>" + OutcomeText(row);
  if (row.ratio) caption += ", " + Fixed(*row.ratio, 2) + " × shortest";
  return std::string("<figure") + (row.is_right ? "" : " class=\"wrong\"") + ">" + Picture(*row.course, *row.record) +
         "<figcaption>" + caption + "</figcaption></figure>\n";
}

std::string WorldSection(const Course& course, const std::vector<Row>& rows) {
  std::string text =
      "<h2>" + EscapedMarkup(course.name) + "</h2>\n<p>" +
      (course.shortest ? "Shortest path " + Fixed(course.shortest->length, 2) + " m." : "The goal cannot be reached.") +
      "</p>\n<div class=\"runs\">\n";
  for (const Row& row : rows) {
    if (row.course == &course) text += Figure(row);
  }
  return text + "</div>\n";
}

}  // namespace

std::string HtmlReport(const Matrix& matrix, const std::vector<RunRecord>& records, const RunSettings& settings) {
  const std::vector<Row> rows = RowsOf(matrix, records);
  std::string worlds;
  for (const Course& course : matrix.courses) {
    if (std::ranges::find(rows, &course, &Row::course) != rows.end()) worlds += WorldSection(course, rows);
  }
  std::string page(kPage);
  // The last one first: whatever is filled in is searched no more.
  const auto fill = [&page](std::string_view place, const std::string& text) {
    page.replace(page.find(place), place.size(), text);
  };
  fill("{runs}", HtmlTable(RunTable(rows), rows));
  fill("{worlds}", worlds);
  fill("{variants}", HtmlTable(SummaryTable(rows)));
  fill("{settings}", fmt::format("{} runs; noise of the ranges {:.3f} m, safe distance {:.2f} m; {}.", records.size(),
                                 settings.noise, settings.safe_distance, TextOf(SpeedOf(records))));
  return page;
}

Result<void> WritePicture(const std::filesystem::path& folder, const Course& course, const RunRecord& record) {
  return WriteFile(folder / (FileNameOf(record.key) + ".svg"), Picture(course, record));
}

}  // namespace runnel::arena
