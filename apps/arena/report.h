#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "apps/arena/course.h"
#include "apps/arena/matrix.h"
#include "apps/arena/run_record.h"
#include "core/base/result.h"

namespace runnel::arena {

/// What a table says of a run.
struct Row {
  const Course* course = nullptr;
  const RunRecord* record = nullptr;
  bool is_right = false;             ///< its verdict is the true one
  std::optional<double> ratio = {};  ///< of the path to the shortest one; only if the goal was reached
  std::optional<double> bound = {};  ///< m, see BoundOf
  bool is_over_bound = false;
};

/// Whether a variant that guarantees nothing has gone on until its time was over: planning/com leaves obstacles wherever the
/// way is free, and may go in circles for ever, and a network of behaviours knows no unreachable goal.
[[nodiscard]] bool MayFailByDesign(const RunRecord& record);

/// In the order of the records.
[[nodiscard]] std::vector<Row> RowsOf(const Matrix& matrix, const std::vector<RunRecord>& records);

/// Over all runs of a variant.
struct Summary {
  std::string variant;
  std::size_t runs = 0;
  std::size_t right = 0;    ///< with the true verdict
  std::size_t reached = 0;  ///< rightly: those that the mean is of
  std::optional<double> mean_ratio = {};
  double path_length = 0.0;  ///< m, of all
};
/// In the order in which variants first appear.
[[nodiscard]] std::vector<Summary> SummariesOf(const std::vector<Row>& rows);

/// How fast the runs were: simulated seconds per second. 0 if nothing has run.
struct Speed {
  double of_wall_time = 0.0;       ///< of a process, which keeps one core busy if it gets one
  double of_processor_time = 0.0;  ///< whatever else the machine was doing
};
[[nodiscard]] Speed SpeedOf(const std::vector<RunRecord>& records);
/// "250 simulated seconds per real second and core, 600 per second of processor time".
[[nodiscard]] std::string TextOf(const Speed& speed);

/// Columns of words first, then of numbers; behind them a line may have a remark.
struct TextTable {
  std::vector<std::string> titles;
  std::size_t words;
  std::size_t numbers;
  std::vector<std::vector<std::string>> lines = {};
  [[nodiscard]] bool IsNumber(std::size_t column) const { return column >= words && column < words + numbers; }
};
[[nodiscard]] TextTable RunTable(const std::vector<Row>& rows);
[[nodiscard]] TextTable SummaryTable(const std::vector<Row>& rows);
/// Whether the verdict is wrong, and what the run itself has to say.
[[nodiscard]] std::string RemarkOf(const Row& row);

/// A block for each world, one for the variants, and notes.
[[nodiscard]] std::string TablesText(const std::vector<Row>& rows, const std::vector<RunRecord>& records);

/// With so many digits after the point.
[[nodiscard]] std::string Fixed(double number, int digits);

/// A page of its own, which needs nothing from elsewhere: a summary of the variants, all paths over
/// their worlds as small pictures, and a table of all runs that can be sorted by any column. For
/// light and dark surroundings.
[[nodiscard]] std::string HtmlReport(const Matrix& matrix, const std::vector<RunRecord>& records,
                                     const RunSettings& settings);
/// What is in page/, with the places for the rest in braces.
extern const std::string_view kPage;

/// Draws the run as the referee does, into <folder>/<world>-<variant>-<sensor>-<direction>-<seed>.svg. Errors: it cannot be written.
Result<void> WritePicture(const std::filesystem::path& folder, const Course& course, const RunRecord& record);

}  // namespace runnel::arena
