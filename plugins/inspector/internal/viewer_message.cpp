#include "plugins/inspector/internal/viewer_message.h"

#include <cmath>
#include <limits>
#include <utility>

#include <nlohmann/json.hpp>

#include "plugins/inspector/internal/change_message.h"

namespace runnel::internal {

namespace {

using Json = nlohmann::json;

constexpr int kDeepest = 4;
// Whole numbers that every JSON reader gets right.
constexpr double kLargestWhole = 9007199254740992.0;

/// Takes members out of an object; remembers the first that is not what it should be.
class Reader {
 public:
  explicit Reader(const Json& json) : json_(json) {}

  void Text(const char* key, std::string& to) {
    if (const Json* const found = Find(key)) {
      if (!found->is_string()) return Complain(key, "a text");
      to = found->get<std::string>();
    }
  }
  void Changes(const char* key, ViewerMessage& message) {
    const Json* const found = Find(key);
    if (found == nullptr) return;
    if (!found->is_array()) return Complain(key, "a list of changes");
    for (std::size_t i = 0; i < found->size(); ++i) {
      auto change = ParseChange((*found)[i]);
      if (change) {
        message.changes.push_back(std::move(*change));
      } else {
        message.wrong_changes.push_back({change.error(), i});
      }
    }
  }
  void Number(const char* key, std::optional<double>& to) {
    if (const Json* const found = Find(key)) {
      const double number = found->is_number() ? found->get<double>() : -1;
      if (!std::isfinite(number) || number < 0) return Complain(key, "a number, not below 0");
      to = number;
    }
  }
  std::optional<std::uint64_t> Whole(const char* key) {
    std::optional<double> number;
    Number(key, number);
    if (!number) return {};
    if (*number != std::floor(*number) || *number > kLargestWhole) {
      Complain(key, "a whole number");
      return {};
    }
    return static_cast<std::uint64_t>(*number);
  }
  [[nodiscard]] const std::optional<Error>& error() const { return error_; }

 private:
  const Json* Find(const char* key) const {
    const auto found = json_.find(key);
    return found == json_.end() || found->is_null() ? nullptr : &*found;
  }
  void Complain(const char* key, const char* what) {
    if (!error_) error_ = Error{.message = "\"" + std::string(key) + "\" must be " + what};
  }

  const Json& json_;
  std::optional<Error> error_;
};

}  // namespace

Result<ViewerMessage> ParseViewerMessage(std::string_view text) {
  bool is_too_deep = false;
  const auto look = [&](int depth, Json::parse_event_t event, Json&) {
    const bool opens =
        event == Json::parse_event_t::object_start || event == Json::parse_event_t::array_start;
    if (opens && depth >= kDeepest) is_too_deep = true;
    return !is_too_deep;
  };
  const Json json = Json::parse(text.begin(), text.end(), look, false);
  if (is_too_deep) return Error{.message = "the message is nested too deeply"};
  if (!json.is_object()) return Error{.message = "the message is not a JSON object"};
  ViewerMessage message;
  Reader reader(json);
  reader.Text("op", message.op);
  reader.Text("path", message.path);
  reader.Text("label", message.label);
  reader.Changes("changes", message);
  reader.Text("file", message.file);
  reader.Text("plugin", message.plugin);
  reader.Number("rate", message.rate);
  reader.Number("speed", message.speed);
  message.request = reader.Whole("request");
  message.elements = reader.Whole("elements").value_or(message.elements);
  message.cycles = reader.Whole("cycles").value_or(message.cycles);
  if (reader.error()) {
    Error error = *reader.error();
    if (!message.op.empty()) error.message = "of '" + message.op + "', " + error.message;
    return error;
  }
  if (message.op.empty()) return Error{.message = "the message has no \"op\""};
  return message;
}

}  // namespace runnel::internal
