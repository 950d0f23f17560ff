#include "bench/report/charts.h"

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <fstream>
#include <stdexcept>

namespace runnel::bench {

namespace {

/// What goes into one chart.
struct Sheet {
  std::string name;
  bool is_family = false;
  std::vector<const Measurement*> measurements;
};

std::vector<Sheet> CollectSheets(const Results& results) {
  std::vector<Sheet> sheets;
  for (const Measurement& each : results.all()) {
    if (each.subject.role == Role::kBaseline || each.samples.empty()) continue;
    const bool is_family = !each.workload.family.empty();
    const std::string name = (is_family ? each.workload.family : each.workload.name) + ", " + each.quantity.name;
    auto sheet = std::ranges::find(sheets, name, &Sheet::name);
    if (sheet == sheets.end()) sheet = sheets.insert(sheets.end(), Sheet{name, is_family, {}});
    sheet->measurements.push_back(&each);
  }
  return sheets;
}

std::string FileNameOf(const std::string& name) {
  std::string file;
  for (const char c : name) {
    if (std::isalnum(static_cast<unsigned char>(c)) != 0) {
      file += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    } else if (!file.empty() && file.back() != '_') {
      file += '_';
    }
  }
  return file + ".svg";
}

void Write(const std::filesystem::path& file, const std::string& text) {
  std::ofstream stream(file);
  stream << text;
  if (!stream.flush()) throw std::runtime_error("cannot write " + file.string());
}

}  // namespace

void WriteCharts(const std::string& folder, const Results& results) {
  std::filesystem::create_directories(folder);
  std::string index =
      "<!DOCTYPE html><html><head><meta charset=\"utf-8\"><title>Runnel "
      "bench</title></head><body>\n";
  for (const Sheet& sheet : CollectSheets(results)) {
    const std::string file = FileNameOf(sheet.name);
    Write(std::filesystem::path(folder) / file,
          sheet.is_family ? LineChart(sheet.measurements) : BarChart(sheet.measurements));
    index += "<p><img src=\"" + file + "\" alt=\"" + sheet.name + "\"></p>\n";
  }
  Write(std::filesystem::path(folder) / "index.html", index + "</body></html>\n");
}

}  // namespace runnel::bench
