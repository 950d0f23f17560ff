#include "plugins/structure/change_fields.h"

#include <algorithm>
#include <utility>

#include "core/base/nearest_name.h"
#include "core/types/text_format.h"
#include "plugins/structure/change_members.h"

namespace runnel {

namespace {

using internal::Member;
using FieldKind = FieldForm::Kind;
using Place = FieldForm::Place;
using Words = std::vector<std::string>;
using enum Proposal;

constexpr std::uint64_t kLongestProbation = 1'000'000'000;
constexpr std::uint64_t kHighestPriority = 99;
constexpr std::uint64_t kAny = std::numeric_limits<std::uint64_t>::max();

// clang-format off
template <auto Said>
FieldForm Word(const char* name, const char* shown, const char* missing, Proposal proposal, const char* help = "",
               Place place = Place::kWord, const char* word_before = "") {
  return Member<Said>({.name = name, .shown = shown, .missing = missing, .help = help, .proposal = proposal,
                       .place = place, .word_before = word_before});
}
template <auto... Said>
FieldForm Option(const char* name, const char* shown, const char* help = "", std::uint64_t most = kAny) {
  return Member<Said...>({.name = name, .shown = shown, .help = help, .place = Place::kOption, .most = most});
}
template <auto Said>
FieldForm Settings() {
  return Option<Said>("settings", "NAME=VALUE");
}

template <typename Said, typename... Fields>
ChangeForm Form(const char* name, const char* help, const char* example, Fields... fields) {
  return {.name = name, .help = help, .example = example, .fields = {std::move(fields)...},
          .kind = Change(Said{}).index(), .make = [] { return Change(Said{}); }};
}
ChangeForm WithWordsHelp(const char* words_help, ChangeForm form) {
  form.words_help = words_help;
  return form;
}
ChangeForm MovesNothing(ChangeForm form) {
  form.lets_move = false;
  return form;
}

std::optional<std::pair<std::string, Error>> CheckConnection(const Change& change, const ChangeForm::IsSaid& is_said) {
  const ConnectOptions& options = std::get<ConnectPorts>(change).options;
  if (is_said("on_full") && options.queue == 0) {
    return std::pair("on_full", Error{.message = "on_full has no meaning without a queue",
                                      .hint = "add queue=N with a count above 0, or leave out on_full"});
  }
  if (!options.pull || options.queue == 0) return {};
  return std::pair("pull", Error{.message = "a connection that pulls cannot have a queue",
                                 .hint = "what is pulled is the newest value; leave out one of the two"});
}

// What is said of a port to others in the network, as in the file: what it means, the extension knows.
ChangeForm ExtensionForm(ChangeForm form, const std::string& tag, const Words& names) {
  const std::size_t count = form.fields.size();
  form.make = [verb = form.name, count] { return Change(ExtensionChange{verb, Words(count)}); };
  for (std::size_t i = 0; i < count; ++i) {
    form.fields[i].get = [i](const Change& change) -> FieldValue {
      const Words& words = std::get<ExtensionChange>(change).words;
      return i < words.size() ? words[i] : "";
    };
    form.fields[i].set = [i](Change& change, FieldValue value) {
      std::get<ExtensionChange>(change).words.at(i) = std::get<std::string>(std::move(value));
    };
  }
  FieldForm settings = Settings<&ExtensionChange::settings>();
  for (const std::string& each : names) {
    const bool ends = each == "remove";
    settings.known.push_back({.name = each, .shown = "TEXT", .help = ends ? "ends it" : "as in " + tag,
                              .place = Place::kOption, .kind = ends ? FieldKind::kFlag : FieldKind::kText,
                              .words = ends ? Words{"", "true"} : Words(), .flags = "--" + each});
  }
  form.fields.push_back(std::move(settings));
  return form;
}

// `options`: the way to the struct that has them.
template <typename Said, typename Options, auto... options>
ChangeForm ThreadForm(const char* name, const char* help, const char* example, FieldForm path) {
  return Form<Said>(name, help, example, std::move(path),
    Option<options..., &Options::activation>("activation", "WORD", "period, free_running, trigger (when data comes)"),
    Option<options..., &Options::period>("period", "TIME", "20ms, for example"),
    Option<options..., &Options::priority>("priority", "N", "0: ordinary; 1 .. 99: real-time", kHighestPriority),
    Option<options..., &Options::on_overrun>("on_overrun", "WORD", "skip, catch_up"));
}

std::vector<ChangeForm> CreateForms() {
  using Create = CreateModule;
  return {
    WithWordsHelp("path, module type and values of parameters", Form<Create>("create",
      "makes a module; 'create group PATH'; 'create port PATH input TYPE'; 'create parameter PATH PARAMETER ...'; "
      "'create thread NAME period=10ms'", "create /robot/filter sensors/scan_filter window=5",
      Word<&Create::path>("path", "PATH", "a path", kNewPath),
      Word<&Create::type>("type", "TYPE", "a module type", kModuleType), Settings<&Create::settings>())),
    MovesNothing(Form<CreateGroup>("create_group", "", "create group /robot/left",
      Word<&CreateGroup::path>("path", "PATH", "a path", kNewPath))),
    Form<CreatePort>("create_port", "",
      "create port /robot/left/scan input RangeScan description=\"of the front laser\"",
      Word<&CreatePort::path>("path", "PATH", "a path", kNewPath),
      Word<&CreatePort::direction>("direction", "", "'input' or 'output'", kNothing),
      Word<&CreatePort::type>("type", "TYPE", "a data type", kNothing),
      Option<&CreatePort::description>("description", "TEXT")),
    Form<CreateParameter>("create_parameter", "", "create parameter /robot/radius left/radius right/radius",
      Word<&CreateParameter::path>("path", "PATH", "a path", kNewPath),
      Word<&CreateParameter::targets>("targets", "PARAMETER", "a parameter that it stands for", kParameter),
      Option<&CreateParameter::description>("description", "TEXT")),
    MovesNothing(ThreadForm<AddThread, ThreadOptions, &AddThread::options>("create_thread", "",
      "create thread fast period=5ms priority=20", Word<&AddThread::name>("path", "NAME", "a name", kNothing)))};
}

std::vector<ChangeForm> ConnectionForms() {
  using Connect = ConnectPorts;
  using O = ConnectOptions;
  constexpr auto kOptions = &Connect::options;
  ChangeForm connect = Form<Connect>("connect", "connects two ports",
    "connect /laser/scan /robot/planner/scan queue=10",
    Word<&Connect::from>("from", "FROM[.PART]", "the output", kSender,
      "output; PORT.x, PORT[0]: that part of its values"),
    Word<&Connect::to>("to", "TO", "the input", kReceiver, "input"),
    Option<kOptions, &O::queue>("queue", "N", "so many values may wait", O::kLongestQueue),
    Option<kOptions, &O::on_full>("on_full", "WORD", "what a full queue does: drop_oldest, drop_newest, refuse"),
    Option<kOptions, &O::pull>("pull", "", "reading the input has the output make a value"),
    Option<kOptions, &O::convert>("convert", "NAME",
      "by which conversion: round, truncate, parse, or what a plugin has registered"),
    Option<kOptions, &O::when_present>("when_present", "", "as soon as both are there, and again after one went"),
    Option<kOptions, &O::late>("late", "", "in a loop of modules, values come one cycle late by this one"));
  connect.check = CheckConnection;
  connect.fields.front().get = [](const Change& change) -> FieldValue {
    return std::get<Connect>(change).from + std::get<Connect>(change).options.PartText();
  };
  FieldForm& when_present = connect.fields[6];
  when_present.text_name = "when";
  when_present.words = {"", "present"};
  FieldForm port{.name = "port", .shown = "PORT", .missing = "a path", .help = "output or interface port",
    .proposal = kSender};
  FieldForm input{.name = "port", .shown = "PORT", .missing = "a path", .help = "input", .proposal = kReceiver};
  return {
    ExtensionForm({"offer", "lets others in the network read a port; --remove ends it",
      "offer /laser/scan topic=/scan", {port}},
      "<offer>", {"topic", "as", "frame", "child_frame", "qos", "sending", "rate", "strength", "remove"}),
    ExtensionForm({"take", "feeds a topic of the network into an input; --remove ends it", "take /cmd_vel /drive/twist",
      {{.name = "topic", .shown = "TOPIC", .missing = "a path", .help = "its name: /cmd_vel"}, input}},
      "<take>", {"as", "field", "qos", "stamp", "exclusive", "live", "remove"}),
    connect,
    Form<DisconnectPorts>("disconnect", "takes the connection of two ports back",
      "disconnect /laser/scan /robot/planner/scan",
      Word<&DisconnectPorts::from>("from", "FROM", "the output", kSender, "output"),
      Word<&DisconnectPorts::to>("to", "TO", "the input", kReceiver, "input"))};
}

// Of what is there.
std::vector<ChangeForm> OtherForms() {
  using Replace = ReplaceModule;
  ChangeForm set = Form<SetParameter>("set", "gives a parameter another value", "set /robot/planner/cruise_speed 0.3",
    Word<&SetParameter::path>("path", "PATH", "the path of a parameter", kParameter, "of the parameter"),
    Word<&SetParameter::value>("value", "VALUE", "a value", kValue, "in its text format"));
  set.usage_note = ", with a VALUE that has blanks in quotation marks";
  set.fields.back().get = [](const Change& change) -> FieldValue {
    const auto& said = std::get<SetParameter>(change);
    return said.object ? ToText(*said.type, said.object.get()) : said.value;
  };
  ChangeForm replace = WithWordsHelp("path, new type and values of parameters", Form<Replace>("replace",
    "puts another module in the place of one, with its connections",
    "replace /robot/planner with planning/tangent_bug step=0.1",
    Word<&Replace::path>("path", "PATH", "the path of a module", kModule),
    Word<&Replace::type>("type", "TYPE", "a module type", kModuleType, "", Place::kWord, "with"),
    Settings<&Replace::settings>(),
    Option<&Replace::probation_cycles>("probation", "CYCLES",
      "the old one comes back if the new one throws in so many first cycles (10)", kLongestProbation)));
  replace.command = "swap";
  return {
    set, replace,
    Form<DeleteElement>("delete", "deletes a module, a group or an interface port", "delete /robot/filter",
      Word<&DeleteElement::path>("path", "PATH", "a path", kDeletable, "of what is to go")),
    Form<RenameElement>("rename", "gives a module or group another name; connections and state stay",
      "rename /robot/planner old_planner",
      Word<&RenameElement::path>("path", "PATH", "a path", kPart, "module or group"),
      Word<&RenameElement::name>("name", "NAME", "the new name", kNothing, "the new one")),
    Form<CopyElement>("copy", "makes another module or group like one, beside it, with its values",
      "copy /robot/planner second_planner", Word<&CopyElement::path>("path", "PATH", "a path", kPart,
        "module or group"),
      Word<&CopyElement::name>("name", "NAME", "a name", kNothing, "of the copy; without, the first that is free",
                               Place::kOptionalWord)),
    Form<AssignToThread>("move", "has a module or group run by another thread", "move /robot/planner to control",
      Word<&AssignToThread::path>("path", "PATH", "a path", kPart, "module or group"),
      Word<&AssignToThread::thread>("thread", "THREAD", "a thread", kThread, "its name; \"\": that of the group again",
                                    Place::kWord, "to")),
    WithWordsHelp("path, and its tags", MovesNothing(Form<TagElement>("tag",
      "says something of an element to viewers: safety, hidden; without a word, nothing any more",
        "tag /robot/planner safety",
      Word<&TagElement::path>("path", "PATH", "a path", kPart),
      Word<&TagElement::tags>("tags", "WORD", "a tag", kNothing, "", Place::kOptionalWord)))),
    MovesNothing(Form<LogElement>("log", "", "log /robot debug", Word<&LogElement::path>("path", "PATH", "a path",
      kPart),
      Word<&LogElement::level>("level", "", "a level", kNothing))),
    ThreadForm<ScheduleThread, ScheduleThread>("schedule",
      "gives a thread another period, priority, or way in which its cycles begin", "schedule control period=10ms",
      Word<&ScheduleThread::thread>("path", "THREAD", "a thread", kThread, "or its name"))};
}
// clang-format on

}  // namespace

const std::vector<ChangeForm>& ChangeForms() {
  static const std::vector<ChangeForm> all = [] {
    std::vector<ChangeForm> forms = ConnectionForms();
    for (const auto& others : {CreateForms(), OtherForms()}) forms.insert(forms.end(), others.begin(), others.end());
    return forms;
  }();
  return all;
}

Result<const ChangeForm*> FindChangeForm(std::string_view name) {
  const auto found = std::ranges::find(ChangeForms(), name, &ChangeForm::name);
  if (found != ChangeForms().end()) return &*found;
  return Error{.message = "there is no change '" + std::string(name) + "'",
               .hint = NearestNameHint(name, NamesOf(ChangeForms(), &ChangeForm::name))};
}

const ChangeForm* FormOf(const Change& change) {
  const auto* const extension = std::get_if<ExtensionChange>(&change);
  const auto found = std::ranges::find_if(ChangeForms(), [&](const ChangeForm& each) {
    return extension != nullptr ? each.name == extension->verb : each.kind == change.index();
  });
  return found != ChangeForms().end() ? &*found : nullptr;
}

}  // namespace runnel
