#include <mutex>

#include "core/port/path_search.h"
#include "plugins/control/command.h"
#include "plugins/control/element_listing.h"

namespace runnel {

namespace {

// How long rates are counted for a long listing, by the machine's clock.
constexpr Duration kRateWindow = std::chrono::milliseconds(500);

class ListCommand final : public Command {
 public:
  ListCommand(Runtime& runtime, std::string path, bool is_long)
      : runtime_(runtime), path_(std::move(path)) {
    options_.is_long = is_long;
  }

  std::optional<ControlCode> Continue(Answer& answer) override {
    const std::unique_lock lock(runtime_.structure_mutex(), std::try_to_lock);
    if (!lock) {
      ContinueIn(kLookAgain);
      return {};
    }
    const auto start = PathSearch(runtime_).Find(path_);
    if (!start) {
      answer.WriteError(ErrorLine(start.error()));
      return ControlCode::kBadInput;
    }
    const Time now = runtime_.clock().Now();
    if (options_.is_long && !has_counted_) {
      has_counted_ = true;
      options_.before = CountPublications(**start);
      counted_at_ = now;
      ContinueIn(kRateWindow);
      return {};
    }
    options_.since = now - counted_at_;
    answer.Write(ListElements(**start, options_));
    return ControlCode::kDone;
  }

 private:
  Runtime& runtime_;
  const std::string path_;
  ListingOptions options_;
  bool has_counted_ = false;
  Time counted_at_{};
};

class PathsCommand final : public Command {
 public:
  explicit PathsCommand(Runtime& runtime) : runtime_(runtime) {}

  std::optional<ControlCode> Continue(Answer& answer) override {
    const std::unique_lock lock(runtime_.structure_mutex(), std::try_to_lock);
    if (!lock) {
      ContinueIn(kLookAgain);
      return {};
    }
    answer.Write(ListPaths(runtime_.root()));
    return ControlCode::kDone;
  }

 private:
  Runtime& runtime_;
};

class TypesCommand final : public Command {
 public:
  explicit TypesCommand(const ServedApplication& application) : application_(application) {}

  std::optional<ControlCode> Continue(Answer& answer) override {
    // Plugins are loaded under it.
    const std::unique_lock lock(application_.runtime.structure_mutex(), std::try_to_lock);
    if (!lock) {
      ContinueIn(kLookAgain);
      return {};
    }
    std::string text;
    for (const ModuleType* type : application_.modules.All()) {
      text += type->name + (type->summary.empty() ? "" : "\t" + type->summary) + "\n";
    }
    answer.Write(text);
    return ControlCode::kDone;
  }

 private:
  const ServedApplication& application_;
};

}  // namespace

CommandResult MakeListCommand(const Request& request, const ServedApplication& application) {
  const std::string path = request.arguments.empty() ? "" : request.arguments[0];
  return std::unique_ptr<Command>(
      std::make_unique<ListCommand>(application.runtime, path, request.Has("long")));
}

CommandResult MakePathsCommand(const Request&, const ServedApplication& application) {
  return std::unique_ptr<Command>(std::make_unique<PathsCommand>(application.runtime));
}

CommandResult MakeTypesCommand(const Request&, const ServedApplication& application) {
  return std::unique_ptr<Command>(std::make_unique<TypesCommand>(application));
}

}  // namespace runnel
