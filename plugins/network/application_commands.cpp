#include "plugins/network/application_commands.h"

#include <algorithm>
#include <sstream>
#include <utility>

#include "core/base/nearest_name.h"
#include "core/paths/distant_ports.h"
#include "plugins/cdr_values/cdr_reader.h"
#include "plugins/cdr_values/cdr_writer.h"
#include "plugins/ros_messages/names.h"
#include "plugins/structure/change_text.h"

namespace runnel {

namespace {

using SteadyTime = std::chrono::steady_clock::time_point;

// So long the words of a client who asks no more are kept.
constexpr auto kForgotten = std::chrono::seconds(20);
constexpr auto kAgain = std::chrono::seconds(1);
constexpr std::size_t kMostReplies = 32;  // that are kept for who asks again
constexpr std::size_t kMostErrands = 32;
constexpr char kBreak = '\n';  // between id, outcome and text

WireEndpointOptions Endpoint(const std::string& name, const char* what) {
  return {.topic = DdsTopic(NearestRosName("/" + name + "/runnel_" + what)), .type = "std_msgs::msg::dds_::String_", .qos = {.depth = 32}};
}

void Write(WireWriter& writer, const std::string& text) {
  auto octets = std::make_shared<Octets>();
  CdrWriter(*octets).PutText(text);
  (void)writer.Write(octets, 0);
}

std::optional<std::string> TextIn(const WireSample& sample) {
  std::string text;
  auto from = CdrReader::Begin(sample.octets);
  return from && from->GetText(text) ? std::optional(text) : std::nullopt;
}

// Of changes that others may be allowed; nullptr: of none of these.
std::string* PathOf(Change& change) {
  if (auto* const set = std::get_if<SetParameter>(&change)) return &set->path;
  if (auto* const swap = std::get_if<ReplaceModule>(&change)) return &swap->path;
  return nullptr;
}
const char* CommandOf(const Change& change) {
  if (std::holds_alternative<SetParameter>(change)) return "set";
  return std::holds_alternative<ReplaceModule>(change) ? "swap" : "";
}

bool Allows(const std::string& user_data, const std::string& command) {
  const std::size_t begin = user_data.find(kAllowedCommands);
  if (begin == std::string::npos) return false;
  std::istringstream words(user_data.substr(begin + std::string_view(kAllowedCommands).size(), user_data.find(';', begin) - begin));
  for (std::string word; std::getline(words, word, ',');) {
    if (word.substr(0, word.find(';')) == command) return true;
  }
  return false;
}

}  // namespace

struct ApplicationCommands::Question {
  std::string id;
  std::string text;
  SteadyTime asked = std::chrono::steady_clock::now();  // by a client, last
  SteadyTime again{};  // is said then, as what was said may have been lost before both had found each other
  std::atomic<std::size_t> hearers{0};
  std::atomic<std::size_t> speakers{0};
  std::mutex mutex;
  std::optional<std::string> reply;  // guarded by mutex
  // Their callbacks use the rest.
  std::unique_ptr<WireWriter> writer;
  std::unique_ptr<WireReader> reader;
};

Result<std::unique_ptr<ApplicationCommands>> ApplicationCommands::Start(NetworkLink& link, NetworkElement& element,
                                                                        CommandService& service) {
  std::unique_ptr<ApplicationCommands> made(new ApplicationCommands(link, element, service));
  const NetworkOptions& options = element.options();
  if (options.commands.empty()) return made;
  auto replies = link.participant().MakeWriter(Endpoint(options.member.name, "replies"), {});
  if (!replies) return replies.error();
  made->replies_ = std::move(*replies);
  auto reader = link.participant().MakeReader(
      Endpoint(options.member.name, "commands"),
      [raw = made.get()](const WireSample& sample) {
        if (const auto text = TextIn(sample)) raw->Hear(*text);
      },
      {});
  if (!reader) return reader.error();
  made->reader_ = std::move(*reader);
  return made;
}

ApplicationCommands::~ApplicationCommands() {
  reader_.reset();
  questions_.clear();
  const std::lock_guard lock(mutex_);
  errands_.clear();
}

// ---- Asking.

Result<std::optional<std::string>> ApplicationCommands::Ask(const std::string& text) {
  Diagnostics diagnostics;
  PlacedChanges placed = ParseChanges(text, {}, diagnostics);
  if (!diagnostics.ok()) return diagnostics.errors().front();
  std::string* const path = placed.changes.size() == 1 ? PathOf(placed.changes.front()) : nullptr;
  if (path == nullptr || !IsDistantPath(*path)) {
    return Error{.message = "others in the network can be told to set a parameter, and to swap a module, one at a time"};
  }
  const std::string whole = *path;
  const std::size_t slash = whole.find('/', 2);
  const std::string name = whole.substr(2, slash == std::string::npos ? slash : slash - 2);
  *path = slash == std::string::npos ? "/" : whole.substr(slash);
  const std::string command = CommandOf(placed.changes.front());
  std::shared_ptr<Question> question;
  {
    const std::lock_guard lock(mutex_);
    const auto now = std::chrono::steady_clock::now();
    std::erase_if(questions_, [&](const auto& each) { return now - each.second->asked > kForgotten; });
    std::shared_ptr<Question>& known = questions_[text];
    if (known == nullptr) {
      known = std::make_shared<Question>();
      known->id = element_.options().member.name + "/" + std::to_string(now.time_since_epoch().count()) + "/" + std::to_string(++asked_);
      known->text = ChangeText(placed.changes.front());
    }
    known->asked = now;
    question = known;
  }
  const auto forget = [&] {
    const std::lock_guard lock(mutex_);
    questions_.erase(text);
  };
  if (question->writer == nullptr) {
    const auto members = link_.table().members();
    const auto found = std::ranges::find(members, name, &WireMember::name);
    if (found == members.end()) {
      forget();
      std::vector<std::string> names;
      for (const WireMember& each : members) names.push_back("//" + each.name);
      return Error{.message = "no //" + name + " is in the network", .path = whole, .hint = NearestNameHint("//" + name, names)};
    }
    if (!Allows(found->user_data, command)) {
      forget();
      return Error{.message = name + " does not let others " + command + " anything",
                   .path = whole,
                   .hint = "<network commands=\"" + command + "\"> in its file would"};
    }
    auto reader = link_.participant().MakeReader(
        Endpoint(name, "replies"),
        [asked = question.get()](const WireSample& sample) {
          const auto heard = TextIn(sample);
          if (!heard || !heard->starts_with(asked->id + kBreak)) return;
          const std::lock_guard lock(asked->mutex);
          asked->reply = heard->substr(asked->id.size() + 1);
        },
        [asked = question.get()](std::size_t count) { asked->speakers = count; });
    if (!reader) return reader.error();
    question->reader = std::move(*reader);
    auto writer = link_.participant().MakeWriter(Endpoint(name, "commands"), [asked = question.get()](std::size_t count) { asked->hearers = count; });
    if (!writer) return writer.error();
    question->writer = std::move(*writer);
  }
  const auto now = std::chrono::steady_clock::now();
  if (now >= question->again && question->hearers > 0 && question->speakers > 0) {
    question->again = now + kAgain;
    Write(*question->writer, question->id + kBreak + "//" + element_.options().member.name + kBreak + question->text);
  }
  std::string reply;
  {
    const std::lock_guard lock(question->mutex);
    if (!question->reply) return std::optional<std::string>();
    reply = *question->reply;
  }
  forget();
  const bool is_done = reply.starts_with("done");
  reply = reply.substr(reply.find(kBreak) + 1);
  while (reply.ends_with('\n')) reply.pop_back();
  if (is_done) return std::optional(name + ": " + reply + "\n");
  return Error{.message = name + " says: " + reply};
}

// ---- Being asked.

std::optional<Error> ApplicationCommands::WhyRefused(const ChangeSet& changes) const {
  for (const Change& each : changes) {
    const std::string command = CommandOf(each);
    if (command.empty() || std::ranges::count(element_.options().commands, command) == 0) {
      return Error{.message = "others may not do that here: '" + ChangeText(each) + "'"};
    }
  }
  return {};
}

// "id\nwho\nchange". By threads of the engine.
void ApplicationCommands::Hear(const std::string& message) {
  const std::size_t first = message.find(kBreak);
  const std::size_t second = first == std::string::npos ? first : message.find(kBreak, first + 1);
  if (second == std::string::npos) return;
  const std::string id = message.substr(0, first);
  if (IsKnown(id)) return;
  Diagnostics diagnostics;
  PlacedChanges placed = ParseChanges(message.substr(second + 1), {}, diagnostics);
  if (const auto why = WhyRefused(placed.changes)) diagnostics.Add(*why);
  // They are seen from the application, whatever it is called here.
  for (Change& each : placed.changes) {
    if (std::string* const path = PathOf(each)) *path = application_ + *path;
  }
  if (!diagnostics.ok() || placed.changes.size() != 1) {
    return Reply(id, {.outcome = CommandAnswer::Outcome::kRefused, .text = {}, .diagnostics = diagnostics, .needs = {}});
  }
  Tend();
  const std::lock_guard lock(mutex_);
  if (errands_.size() >= kMostErrands) {
    return Reply(id, CommandAnswer::Failed({.message = "too much has been asked for already"}));
  }
  const std::string who = message.substr(first + 1, second - first - 1);
  std::string text = ChangeText(placed.changes.front());
  ChangeRequest request{.placed = std::move(placed), .client = who};
  errands_.push_back({id, who + " has it done: " + text, service_.Begin(std::move(request), tasks_, [this] { Tend(); })});
}

// What is asked again is answered again.
bool ApplicationCommands::IsKnown(const std::string& id) {
  {
    const std::lock_guard lock(mutex_);
    if (std::ranges::any_of(errands_, [&](const Errand& each) { return each.id == id; })) return true;
  }
  const std::lock_guard lock(replying_);
  const auto told = std::ranges::find_if(told_, [&](const std::string& each) { return each.starts_with(id + kBreak); });
  if (told == told_.end()) return false;
  Write(*replies_, *told);
  return true;
}

// Answers what has been done. Also by the worker.
void ApplicationCommands::Tend() {
  std::vector<Errand> done;
  {
    const std::lock_guard lock(mutex_);
    for (auto each = errands_.begin(); each != errands_.end();) {
      if (!each->command->is_done()) {
        ++each;
        continue;
      }
      done.push_back(std::move(*each));
      each = errands_.erase(each);
    }
  }
  for (const Errand& each : done) {
    const CommandAnswer answer = each.command->Take();
    if (answer) element_.log().Info("{}", each.text);
    Reply(each.id, answer);
  }
}

void ApplicationCommands::Reply(const std::string& id, const CommandAnswer& answer) {
  std::string text = answer ? answer.text : "";
  for (const Error& each : answer.diagnostics.errors()) text += (text.empty() ? "" : "\n") + each.ToString();
  const std::lock_guard lock(replying_);
  told_.push_back(id + kBreak + (answer ? "done" : "refused") + kBreak + text);
  if (told_.size() > kMostReplies) told_.pop_front();
  Write(*replies_, told_.back());
}

}  // namespace runnel
