#include "plugins/inspector/panel_file.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
#include <iterator>
#include <set>
#include <utility>
#include <vector>

#include "core/base/files.h"
#include "core/base/nearest_name.h"
#include "plugins/values/json_reader.h"

namespace runnel {

namespace {

constexpr std::size_t kLongestText = 256 * 1024;
constexpr std::size_t kMostWidgets = 200;
constexpr std::uint64_t kVersion = 1;
constexpr std::uint64_t kColumns = 12;
constexpr std::uint64_t kMostRows = 1000;
constexpr int kDeepest = 6;

const std::vector<std::string>& Kinds() {
  static const std::vector<std::string> kinds{"joystick", "keys", "gamepad", "slider", "button", "switch", "gauge",
                                              "plot",     "map",  "image",   "value",  "text",   "stop"};
  return kinds;
}

enum class Kind { kText, kNumber, kFlag, kCurves };

// What widgets say of themselves; which of them have what, the page knows.
constexpr std::array kSettings{
    std::pair("title", Kind::kText),   std::pair("target", Kind::kText),    std::pair("field", Kind::kText),
    std::pair("text", Kind::kText),    std::pair("pressed", Kind::kText),   std::pair("on", Kind::kText),
    std::pair("off", Kind::kText),     std::pair("unit", Kind::kText),      std::pair("forward", Kind::kNumber),
    std::pair("turn", Kind::kNumber),  std::pair("minimum", Kind::kNumber), std::pair("maximum", Kind::kNumber),
    std::pair("step", Kind::kNumber),  std::pair("seconds", Kind::kNumber), std::pair("held", Kind::kFlag),
    std::pair("curves", Kind::kCurves)};

void CheckCurves(JsonMembers& members, const std::string& name) {
  for (const JsonPart& each : members.List(name).value_or(std::vector<JsonPart>())) {
    JsonMembers curve(each);
    curve.NeedText("target");
    curve.Text("field");
    curve.RefuseOthers();
    if (curve.error()) members.Complain("\"" + name + "\" must be a list of {\"target\", \"field\"}");
  }
}

// One of a wrong kind would leave every viewer without a panel.
void CheckSetting(JsonMembers& members, const std::string& name, Kind kind) {
  if (kind == Kind::kCurves) return CheckCurves(members, name);
  const JsonPart* const found = members.Find(name);
  if (found == nullptr || found->is_null()) return;
  const auto number = found->number();
  if (kind == Kind::kText && !found->text()) members.Complain("\"" + name + "\" must be a text");
  if (kind == Kind::kFlag && !found->boolean()) members.Complain("\"" + name + "\" must be true or false");
  if (kind == Kind::kNumber && !(number && std::isfinite(*number)))
    members.Complain("\"" + name + "\" must be a number");
}

Result<void> CheckWidget(const JsonPart& json, std::set<std::string>& ids) {
  if (!json.is_object()) return Error{.message = "is no object"};
  JsonMembers members(json);
  const std::string id = members.NeedText("id");
  const std::string kind = members.NeedText("kind");
  const std::uint64_t x = members.NeedCount("x", kColumns - 1);
  members.NeedCount("y", kMostRows);
  const std::uint64_t width = members.NeedCount("w", kColumns);
  const std::uint64_t height = members.NeedCount("h", kMostRows);
  for (const auto& [name, its_kind] : kSettings) CheckSetting(members, name, its_kind);
  members.RefuseOthers();
  if (members.error()) return *members.error();
  if (std::ranges::find(Kinds(), kind) == Kinds().end()) {
    return Error{.message = "there is no kind '" + kind + "'", .hint = NearestNameHint(kind, Kinds())};
  }
  if (width == 0 || height == 0 || x + width > kColumns) {
    return Error{.message = "'" + id + "' lies beside the grid of " + std::to_string(kColumns) + " columns"};
  }
  if (!ids.insert(id).second) return Error{.message = "there are two '" + id + "'"};
  return {};
}

}  // namespace

Result<void> CheckPanel(std::string_view text) {
  if (text.size() > kLongestText) return Error{.message = "the panel is longer than 256 kB"};
  const auto json = JsonPart::Parse(text, kDeepest);
  if (!json) return json.error().WithContext("the panel cannot be read");
  if (!json->is_object()) return Error{.message = "the panel is no JSON object"};
  JsonMembers members(*json);
  const std::uint64_t version = members.NeedCount("panel", 1'000'000);
  const std::vector<JsonPart> widgets = members.NeedList("widgets");
  members.RefuseOthers();
  if (members.error()) return members.error()->WithContext("the panel");
  if (version != kVersion) {
    return Error{.message = "the panel is one of version " + std::to_string(version) + ", not 1"};
  }
  if (widgets.size() > kMostWidgets) return Error{.message = "the panel has more than 200 widgets"};
  std::set<std::string> ids;
  for (std::size_t i = 0; i < widgets.size(); ++i) {
    const auto good = CheckWidget(widgets[i], ids);
    if (!good) return good.error().WithContext("widget " + std::to_string(i + 1) + " of the panel");
  }
  return {};
}

PanelFile::PanelFile(const std::string& application_file)
    : file_(application_file.empty() ? std::filesystem::path()
                                     : std::filesystem::path(application_file).replace_extension(".panel.json")) {}

Result<std::string> PanelFile::Read() const {
  if (file_.empty()) {
    const std::lock_guard lock(mutex_);
    return kept_;
  }
  std::error_code error;
  if (!std::filesystem::exists(file_, error)) return std::string();
  std::ifstream file(file_, std::ios::binary);
  std::string text(std::istreambuf_iterator<char>(file), {});
  if (!file) return Error{.message = "cannot be read", .path = file_.string()};
  if (auto good = CheckPanel(text); !good) return good.error().WithPosition(file_.string());
  return text;
}

Result<std::string> PanelFile::Save(const std::string& text) {
  if (auto good = CheckPanel(text); !good) return good.error();
  if (file_.empty()) {
    const std::lock_guard lock(mutex_);
    kept_ = text;
    return std::string("kept in memory until the application ends: it came from no file");
  }
  if (auto written = ReplaceFile(file_, text); !written) return written.error();
  return "saved the panel to " + file_.string();
}

}  // namespace runnel
