#include "tests/plugins/application_files/reading/file_trial.h"

#include <algorithm>
#include <mutex>
#include <optional>
#include <sstream>
#include <utility>

#include "core/base/characters.h"
#include "core/element/file_notes.h"
#include "core/types/type_info.h"
#include "plugins/application_files/application_builder.h"
#include "plugins/application_files/type_names.h"
#include "plugins/application_tags/run_description.h"
#include "plugins/finroc_files/finroc_application.h"
#include "tests/plugins/application_files/saving/application_text.h"
#include "tests/plugins/application_files/saving/saving_workshop.h"

namespace runnel::testing {

namespace {

namespace fs = std::filesystem;

// An application that is there already, ready, and none of the business of those that come and go.
const char* const kNeighbour = R"(<application name="neighbour" thread="main">
  <thread name="main" period="10ms"/>
  <module name="source" type="test/source"/>
  <module name="sink" type="test/sink"/>
  <module name="optional" type="test/optional"/>
  <connect from="source/value" to="sink/value"/>
</application>)";

const char* const kConfiguration = R"(<configuration>
  <section name="drive"><value name="gain">4</value><value name="other">5</value>
    <value name="bad">much</value></section>
  <section name="brake"><value name="force">2</value></section>
</configuration>)";

const char* const kItself =
    R"(<group_type><group name="g" type="itself.xml"/><group name="h" type="wheel.xml"/></group_type>)";
const char* const kOldItself = R"(<FinstructableGroup>
  <element name="Again" group="finroc_plugins_structure" type="Group">
    <parameters><parameter name="XML file">old_itself.xml</parameter></parameters></element>
</FinstructableGroup>)";

// "" if the place is one of the text.
std::string PlaceFault(const SourcePosition& place, std::string_view text) {
  for (int line = 1; line < place.line; ++line) {
    const std::size_t end = text.find('\n');
    if (end == std::string_view::npos) return "in a line that is not there";
    text.remove_prefix(end + 1);
  }
  const std::size_t length = std::min(text.find('\n'), text.size());
  if (place.line < 1 || place.column < 1) return "without line and column";
  return static_cast<std::size_t>(place.column) > length + 1 ? "in a column that is not there" : "";
}

std::vector<std::string> SortedLines(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);) {
    if (!line.empty()) lines.push_back(line);
  }
  std::ranges::sort(lines);
  return lines;
}

// Without connections to others, which only a file that a person has written may have.
std::string OwnStructure(FrameworkElement& application) {
  std::istringstream lines(StructureText(application));
  std::string own;
  for (std::string line; std::getline(lines, line);) {
    const std::size_t arrow = line.find(" -> ");
    const std::string target = application.path() + "/";
    if (arrow == std::string::npos || line.compare(arrow + 4, target.size(), target) == 0) {
      own += line + "\n";
    }
  }
  return own;
}

// Some file systems bring a file to the disk when it is written again, and at once.
void WriteNew(const fs::path& file, const std::string& text) {
  fs::remove(file);
  WriteAll(file, text);
}

const char* NameOf(BuildMode mode) {
  return mode == BuildMode::kRun ? "run" : mode == BuildMode::kCheck ? "check" : "construct";
}

}  // namespace

struct FileTrial::World : Workshop {
  explicit World(fs::path from) : folder(std::move(from)) {
    Add<Optional>("test/optional");
    (void)CheckPortType("none that there is", plugins);  // makes all of them known
    neighbour = Build(kNeighbour);
    RUNNEL_CHECK(neighbour != nullptr, "the neighbour cannot be built: " + diagnostics.ToString());
    Diagnostics unread;
    outside.Load((folder / "config.xml").string(), unread);
    RUNNEL_CHECK(unread.ok(), "the configuration cannot be read");
  }

  // What outlives an application that comes and goes, as text.
  std::string Snapshot() {
    const std::lock_guard lock(runtime.structure_mutex());
    FrameworkElement& root = runtime.root();
    std::string text = StructureText(root);
    const bool is_annotated =
        root.FindAnnotation<SourcePlace>() != nullptr || root.FindAnnotation<ApplicationSource>() != nullptr ||
        root.FindAnnotation<PartInstance>() != nullptr || root.FindAnnotation<RunRules>() != nullptr ||
        neighbour->FindAnnotation<RunRules>() != nullptr ||
        SchedulerOptionsOf(root).clock != SchedulerOptions{}.clock ||
        SchedulerOptionsOf(*neighbour).clock != SchedulerOptions{}.clock;
    if (is_annotated) text += "annotated\n";
    root.Visit([&](FrameworkElement& each) {
      text += std::to_string(each.id()) + " " + std::to_string(int(each.life_cycle())) + "\n";
    });
    text += std::to_string(plugins.modules().All().size()) + " module types\n";
    for (const char* tag : {"application", "group", "module", "on_stale"}) {
      text +=
          std::to_string(tags.TagsIn(tag).size()) + " " + std::to_string(tags.AddedAttributes(tag).size()) + " words\n";
    }
    return text + std::to_string(RegisteredTypes().size()) + " types\n";
  }

  // What programs build it with.
  [[nodiscard]] BuildTools tools() {
    configuration = outside;
    if (with_argument) RUNNEL_CHECK(configuration.AddArgument("gain=3").has_value(), "twice");
    return {runtime, plugins, tags, configuration};
  }
  // What a program makes of an application before it is ready.
  Result<void> Schedule(FrameworkElement& application) {
    scheduler.emplace(runtime, SchedulerOptionsOf(application));
    supervisor.emplace(runtime, *scheduler, [](const ChangeSet&) { return Result<ChangeSet>(ChangeSet()); });
    return AddRules(application, *scheduler, *supervisor);
  }
  // Schedules what was constructed and makes it ready, or deletes it.
  void Run(BuildOutcome& outcome) {
    if (outcome.application == nullptr) return;
    if (auto scheduled = Schedule(*outcome.application); !scheduled) {
      outcome.diagnostics.Add(scheduled.error());
    }
    FinishBuild(outcome, BuildMode::kRun);
  }
  void StopScheduling() {
    supervisor.reset();
    scheduler.reset();
  }

  const fs::path folder;
  bool with_argument = false;
  FrameworkElement* neighbour = nullptr;
  Configuration outside;
  std::optional<Scheduler> scheduler;
  std::optional<Supervisor> supervisor;
};

FileTrial::FileTrial(fs::path folder, const fs::path& corpus) : folder_(std::move(folder)) {
  fs::create_directories(folder_);
  for (const auto& entry : fs::directory_iterator(corpus)) {
    fs::copy_file(entry.path(), folder_ / entry.path().filename(), fs::copy_options::overwrite_existing);
  }
  WriteAll(folder_ / "itself.xml", kItself);
  WriteAll(folder_ / "old_itself.xml", kOldItself);
  WriteAll(folder_ / "broken.xml", "<group_type>\n  <module name=\"m\"></group_type>");
  WriteAll(folder_ / "config.xml", kConfiguration);
}

FileTrial::~FileTrial() = default;

std::string FileTrial::Try(const std::string& text, std::uint64_t number) {
  if (world_ == nullptr || number % 256 == 0) world_ = std::make_unique<World>(folder_);
  std::string fault;
  try {
    world_->with_argument = number % 16 == 11;
    fault = TryAt(*world_, text, number);
  } catch (const std::exception& exception) {
    fault = std::string("an exception came out: ") + exception.what();
  }
  // Whatever it was, the next one shall not suffer from it.
  if (!fault.empty()) world_.reset();
  return fault;
}

std::string FileTrial::TryAt(World& world, const std::string& text, std::uint64_t number) {
  return number % 4 == 0 ? TryFile(world, text, number) : TryDocument(world, text, number);
}

std::string FileTrial::TryFile(World& world, const std::string& text, std::uint64_t number) {
  const fs::path file = folder_ / "file.xml";
  WriteNew(file, text);
  const std::string before = world.Snapshot();
  const BuildMode mode = number % 8 == 0 ? BuildMode::kConstruct : BuildMode::kRun;
  const BuildOutcome outcome = BuildApplication(file, world.tools(), mode);
  if (std::string fault = JudgePlaces(outcome.diagnostics, text); !fault.empty()) return fault;
  if (outcome.application != nullptr) {
    std::string fault = TrySaving(world, *outcome.application, &text);
    if (!fault.empty()) return fault;
  }
  return Judge(world, outcome, before, mode);
}

std::string FileTrial::TryDocument(World& world, const std::string& text, std::uint64_t number) {
  const auto document = XmlDocument::Parse(text, "app.xml");
  if (!document) {
    ++counts_.unreadable;
    Diagnostics diagnostics;
    diagnostics.Add(document.error());
    return JudgePlaces(diagnostics, text);
  }
  if (document->root().name() == "group_type" && number % 4 == 1) return TryAsPart(world, text);
  const std::string before = world.Snapshot();
  const bool is_old = IsFinrocFile(document->root());
  const auto build = [&](BuildMode mode, bool with_scheduler) {
    const BuildTools tools = world.tools();
    const bool in_two_steps = with_scheduler && mode == BuildMode::kRun;
    const BuildMode first = in_two_steps ? BuildMode::kConstruct : mode;
    BuildOutcome outcome = is_old ? BuildFinrocApplication(*document, folder_ / "app.xml", tools, first)
                                  : BuildApplication(*document, folder_, tools, first);
    if (in_two_steps) world.Run(outcome);
    return outcome;
  };
  const BuildMode mode = number % 4 == 3 ? BuildMode::kConstruct : BuildMode::kRun;
  const BuildOutcome outcome = build(mode, number % 8 == 6);
  world.StopScheduling();
  if (std::string fault = JudgePlaces(outcome.diagnostics, text); !fault.empty()) return fault;
  if (outcome.application != nullptr && number % 3 == 0) {
    std::string fault = TrySaving(world, *outcome.application, nullptr);
    if (!fault.empty()) return fault;
  }
  if (std::string fault = Judge(world, outcome, before, mode); !fault.empty()) return fault;
  if (number % 4 != 3) return "";
  // A check says what building says, and leaves nothing.
  const BuildOutcome checked = build(BuildMode::kCheck, false);
  if (checked.diagnostics.ToString() != outcome.diagnostics.ToString()) {
    return "a check says\n" + checked.diagnostics.ToString() + "and building\n" + outcome.diagnostics.ToString();
  }
  return Judge(world, checked, before, BuildMode::kCheck);
}

// The text is that of a file that others use.
std::string FileTrial::TryAsPart(World& world, const std::string& text) {
  WriteNew(folder_ / "part.xml", text);
  const std::string before = world.Snapshot();
  const auto document = XmlDocument::Parse(
      "<application name='a'><group name='g' type='part.xml'/><group name='h' type='part.xml'>"
      "<parameter name='gain' value='2'/></group></application>",
      "app.xml");
  const BuildOutcome outcome = BuildApplication(*document, folder_, world.tools(), BuildMode::kRun);
  return Judge(world, outcome, before, BuildMode::kRun);
}

std::string FileTrial::Judge(World& world, const BuildOutcome& outcome, const std::string& before, BuildMode mode) {
  const std::string said = outcome.diagnostics.ToString();
  if (!UnwritableCharacter(said).empty()) return "it is told in letters that are none:\n" + said;
  if (!outcome.diagnostics.ok()) {
    if (outcome.application != nullptr) return "an application in spite of\n" + said;
    ++counts_.refused;
  } else if (mode != BuildMode::kCheck) {
    if (outcome.application == nullptr) return "neither an application nor an error";
    if (outcome.application->parent() != &world.runtime.root()) return "it is not below the root";
    if (auto deleted = world.runtime.Delete(*outcome.application); !deleted) {
      return "it cannot be deleted: " + deleted.error().ToString();
    }
    ++counts_.built;
  }
  const std::string after = world.Snapshot();
  if (after == before) return "";
  return std::string(NameOf(mode)) + " leaves\n" + after + "instead of\n" + before + "and says\n" + said;
}

std::string FileTrial::JudgePlaces(const Diagnostics& diagnostics, const std::string& text) const {
  std::vector<Error> all = diagnostics.errors();
  all.insert(all.end(), diagnostics.warnings().begin(), diagnostics.warnings().end());
  for (const Error& error : all) {
    const std::string& file = error.position.file;
    std::string fault;
    if (error.message.empty()) fault = "without a message";
    if (file == "app.xml") {
      fault = PlaceFault(error.position, text);
    } else if (file != "command line" && !fs::exists(file)) {
      fault = "of a file that is not there";
    } else if (file != "command line") {
      fault = PlaceFault(error.position, ReadAll(file));
    }
    if (!fault.empty()) return "told " + fault + ": " + error.ToString();
  }
  return "";
}

// `text`: of the file that it came from.
std::string FileTrial::TrySaving(World& world, FrameworkElement& application, const std::string* text) {
  ++counts_.saved;
  const auto saved = testing::ApplicationText(application, {world.plugins, world.tags}, folder_);
  // A new file knows no other application.
  if (!saved && text == nullptr && saved.error().message.starts_with("only another")) return "";
  if (!saved) return "it cannot be saved: " + saved.error().ToString();
  if (text != nullptr) {
    return *saved == *text ? "" : "saved, though nothing has changed, it is\n" + *saved;
  }
  return TryAgain(*saved, OwnStructure(application));
}

std::string FileTrial::TryAgain(const std::string& saved, const std::string& structure) {
  if (second_ == nullptr) second_ = std::make_unique<World>(folder_);
  World& world = *second_;
  const auto document = XmlDocument::Parse(saved, "saved.xml");
  if (!document) return "saved, it is no XML: " + document.error().ToString() + "\n" + saved;
  const BuildOutcome outcome = BuildApplication(*document, folder_, world.tools(), BuildMode::kConstruct);
  if (outcome.application == nullptr) {
    return "saved, it cannot be loaded:\n" + outcome.diagnostics.ToString() + saved;
  }
  std::string fault;
  const std::string again = OwnStructure(*outcome.application);
  if (again != structure) {
    fault = "saved and loaded, it is\n" + again + "instead of\n" + structure + "by\n" + saved;
  }
  const auto second = testing::ApplicationText(*outcome.application, {world.plugins, world.tags}, folder_);
  // Interface ports may change places.
  if (fault.empty() && (!second || SortedLines(*second) != SortedLines(saved))) {
    fault = "saved twice, it is\n" + (second ? *second : second.error().ToString()) + "\ninstead of\n" + saved;
  }
  if (auto deleted = world.runtime.Delete(*outcome.application); !deleted) second_.reset();
  return fault;
}

}  // namespace runnel::testing
