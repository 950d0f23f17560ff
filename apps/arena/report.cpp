#include "apps/arena/report.h"

#include <algorithm>

#include <fmt/format.h>

#include "apps/arena/bounds.h"
#include "apps/arena/names.h"
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

namespace {

constexpr const char* kNone = "-";

std::string Aligned(const TextTable& table) {
  std::vector<std::size_t> widths(table.words + table.numbers + 1, 0);
  auto lines = table.lines;
  lines.insert(lines.begin(), table.titles);
  for (const auto& line : lines) {
    for (std::size_t i = 0; i < line.size(); ++i) widths[i] = std::max(widths[i], line[i].size());
  }
  std::string text;
  for (const auto& line : lines) {
    std::string out = " ";
    for (std::size_t i = 0; i < line.size(); ++i) {
      out += fmt::format(fmt::runtime(table.IsNumber(i) ? " {:>{}}" : " {:<{}}"), line[i], widths[i]);
    }
    out.erase(out.find_last_not_of(' ') + 1);
    text += out + "\n";
  }
  return text;
}

std::string OrNone(const std::optional<double>& number, int digits) { return number ? Fixed(*number, digits) : kNone; }

std::string WorldText(const Course& course, const std::vector<Row>& rows) {
  std::vector<Row> own;
  std::ranges::copy_if(rows, std::back_inserter(own), [&](const Row& row) { return row.course == &course; });
  TextTable table = RunTable(own);
  // The world stands above.
  table.titles.erase(table.titles.begin());
  for (auto& line : table.lines) line.erase(line.begin());
  --table.words;
  const std::string truth =
      course.shortest ? "shortest path " + Fixed(course.shortest->length, 2) + " m" : "the goal cannot be reached";
  return course.name + ": " + truth + "\n" + Aligned(table) + "\n";
}

}  // namespace

std::string RemarkOf(const Row& row) {
  const std::string& remark = row.record->result.remark;
  if (row.is_right) return remark;
  const std::string fault = MayFailByDesign(*row.record) ? "fails by design, no guarantee" : "WRONG";
  return fault + (remark.empty() ? "" : ": " + remark);
}

TextTable RunTable(const std::vector<Row>& rows) {
  TextTable table{{"world", "variant", "sensor", "direction", "seed", "outcome", "length/m", "ratio", "bound/m ",
                   "time/s", "real/s", "hits", "remark"},
                  6,
                  6};
  for (const Row& row : rows) {
    const RunKey& key = row.record->key;
    const RunResult& result = row.record->result;
    table.lines.push_back({key.world, key.variant, key.sensor, key.direction, std::to_string(key.seed), result.outcome,
                           Fixed(result.path_length, 2), OrNone(row.ratio, 2),
                           OrNone(row.bound, 2) + (row.is_over_bound ? "!" : " "), Fixed(result.simulated_time, 1),
                           Fixed(row.record->wall_time, 2), std::to_string(result.hits.size()), RemarkOf(row)});
  }
  return table;
}

TextTable SummaryTable(const std::vector<Row>& rows) {
  TextTable table{{"variant", "runs", "right", "success", "mean ratio", "all paths/m"}, 1, 5};
  for (const Summary& summary : SummariesOf(rows)) {
    const double share = 100.0 * static_cast<double>(summary.right) / static_cast<double>(summary.runs);
    table.lines.push_back({summary.variant, std::to_string(summary.runs), std::to_string(summary.right),
                           Fixed(share, 1) + " %", OrNone(summary.mean_ratio, 3), Fixed(summary.path_length, 1)});
  }
  return table;
}

std::string Fixed(double number, int digits) { return fmt::format("{:.{}f}", number, digits); }

bool MayFailByDesign(const RunRecord& record) {
  const bool guarantees_nothing = record.key.variant == "com" || record.key.variant == "behaviours/navigator";
  return guarantees_nothing && record.has_ended_by_itself && record.result.outcome == "timeout";
}

std::vector<Row> RowsOf(const Matrix& matrix, const std::vector<RunRecord>& records) {
  std::vector<Row> rows;
  for (const RunRecord& record : records) {
    const auto course = std::ranges::find(matrix.courses, record.key.world, &Course::name);
    if (course == matrix.courses.end()) continue;
    const RunResult& result = record.result;
    Row row{.course = &*course, .record = &record, .is_right = course->IsRight(result.outcome)};
    if (row.is_right && course->shortest && course->shortest->length > 0.0) {
      row.ratio = result.path_length / course->shortest->length;
    }
    if (result.outcome == "reached" || result.outcome == "unreachable") {
      row.bound = BoundOf(record.key.variant, *course, result.hits);
    }
    row.is_over_bound = row.bound && result.path_length > *row.bound;
    rows.push_back(row);
  }
  return rows;
}

std::vector<Summary> SummariesOf(const std::vector<Row>& rows) {
  std::vector<Summary> summaries;
  for (const Row& row : rows) {
    auto summary = std::ranges::find(summaries, row.record->key.variant, &Summary::variant);
    if (summary == summaries.end()) {
      summaries.push_back({.variant = row.record->key.variant});
      summary = summaries.end() - 1;
    }
    ++summary->runs;
    summary->path_length += row.record->result.path_length;
    if (row.is_right) ++summary->right;
    if (!row.ratio) continue;
    const auto before = static_cast<double>(summary->reached++);
    summary->mean_ratio = (summary->mean_ratio.value_or(0.0) * before + *row.ratio) / (before + 1);
  }
  return summaries;
}

Speed SpeedOf(const std::vector<RunRecord>& records) {
  double simulated = 0.0, wall = 0.0, processor = 0.0;
  for (const RunRecord& record : records) {
    if (!record.has_ended_by_itself) continue;
    simulated += record.result.simulated_time;
    wall += record.wall_time;
    processor += record.processor_time;
  }
  return {.of_wall_time = wall > 0.0 ? simulated / wall : 0.0,
          .of_processor_time = processor > 0.0 ? simulated / processor : 0.0};
}

std::string TextOf(const Speed& speed) {
  return Fixed(speed.of_wall_time, 0) + " simulated seconds per real second and core, " +
         Fixed(speed.of_processor_time, 0) + " per second of processor time";
}

std::string TablesText(const std::vector<Row>& rows, const std::vector<RunRecord>& records) {
  std::string text;
  std::vector<const Course*> told;
  for (const Row& row : rows) {
    if (std::ranges::find(told, row.course) != told.end()) continue;
    told.push_back(row.course);
    text += WorldText(*row.course, rows);
  }
  text += "summary\n" + Aligned(SummaryTable(rows));
  if (std::ranges::any_of(rows, &Row::is_over_bound)) {
    text += "  !  longer than the bound, which holds for a point that follows boundaries exactly\n";
  }
  text += TextOf(SpeedOf(records)) + "\n";
  return text;
}

}  // namespace runnel::arena
