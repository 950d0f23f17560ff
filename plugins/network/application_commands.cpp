#include "plugins/network/application_commands.h"

#include <algorithm>
#include <utility>

#include <fmt/ranges.h>

#include "core/base/characters.h"
#include "core/base/erase_where.h"
#include "core/base/nearest_name.h"
#include "core/base/number_text.h"
#include "core/paths/distant_ports.h"
#include "plugins/cdr_values/cdr_stream.h"
#include "plugins/command_service/extension_texts.h"
#include "plugins/ros_messages/message_library.h"
#include "plugins/ros_messages/names.h"
#include "plugins/structure/change_text.h"

namespace runnel {

namespace {

constexpr std::size_t kMostErrands = 32;
constexpr std::uint32_t kIdentity = 0x80000200u;  // beyond that of the STOP
// A token counts for so long, and has to come within as long: whoever asks is then still waiting, and a little longer.
constexpr Duration kTokenLife = ExtensionTexts::kFarPatience * 2 / 5;

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

std::string TextOf(const WireId& id) { return fmt::format("{:02x}", fmt::join(id, "")); }

bool Allows(const std::string& user_data, const std::string& command) {
  const std::size_t found = user_data.find(kAllowedCommands);
  if (found == std::string::npos) return false;
  const std::size_t begin = found + std::string_view(kAllowedCommands).size();
  const std::string list = "," + user_data.substr(begin, user_data.find(';', begin) - begin) + ",";
  return list.find("," + command + ",") != std::string::npos;
}

}  // namespace

std::unique_ptr<ApplicationCommands> ApplicationCommands::Start(NetworkLink& link, NetworkElement& element,
                                                                CommandService& service) {
  std::unique_ptr<ApplicationCommands> made(new ApplicationCommands(link, element, service));
  const NetworkOptions& options = element.options();
  if (options.commands.empty()) return made;
  auto offered = made->Open(ServiceEndpoints::Side::kServer, options.member.name, [raw = made.get()] { raw->Serve(); });
  if (!offered) {
    element.log().Warn("others cannot be let do anything: {}", offered.error().ToString());
    return made;
  }
  {
    const std::lock_guard lock(made->mutex_);
    made->offered_ = std::move(*offered);
  }
  made->Serve();  // what has come meanwhile
  return made;
}

ApplicationCommands::~ApplicationCommands() {
  std::unique_ptr<ServiceEndpoints> offered;  // goes without the lock, as it waits for who serves
  const std::lock_guard lock(mutex_);
  offered.swap(offered_);
  errands_.clear();
  const std::lock_guard open(questions_->mutex);
  questions_->open.clear();
}

// Both ends hear what was said before they had found each other, so nothing is said twice.
Result<std::unique_ptr<ServiceEndpoints>> ApplicationCommands::Open(ServiceEndpoints::Side side,
                                                                    const std::string& name,
                                                                    std::function<void()> on_news) {
  const auto type_of = [](const std::string& message, const std::vector<MessageField>& fields) {
    return ServiceType::Of({.name = "runnel_msgs/srv/" + message, .fields = fields}, MessageLibrary::Standard());
  };
  constexpr auto kText = MessageType::kString;
  static const auto kAsked = type_of("Command_Request", {{"client", kText}, {"change", kText}, {"whom", kText}});
  static const auto kAnswered =
      type_of("Command_Response", {{"success", MessageType::kBool}, {"message", kText}, {"token", kText}});
  return ServiceEndpoints::Start(side,
                                 {.service = NearestRosName("/" + name + "/runnel_commands"),
                                  .request = kAsked,
                                  .response = kAnswered,
                                  .depth = kMostErrands,
                                  .is_latched = true},
                                 link_.participant(), kIdentity + opened_++, std::move(on_news));
}

// ---- Asking.

Result<std::optional<std::string>> ApplicationCommands::Ask(const std::string& text, std::shared_ptr<void>& asking) {
  Diagnostics diagnostics;
  PlacedChanges placed = ParseChanges(text, {}, diagnostics);
  if (!diagnostics.ok()) return diagnostics.errors().front();
  std::string* const path = placed.changes.size() == 1 ? PathOf(placed.changes.front()) : nullptr;
  if (path == nullptr || !IsDistantPath(*path)) {
    return Error{.message =
                     "others in the network can be told to set a parameter, and to swap a module, one at a time"};
  }
  const std::string whole = *path;
  const std::size_t slash = whole.find('/', 2);
  const std::string name = whole.substr(2, slash == std::string::npos ? slash : slash - 2);
  *path = slash == std::string::npos ? "/" : whole.substr(slash);
  if (asking == nullptr) {
    auto begun = Begin(name, whole, placed.changes.front());
    if (!begun) return begun.error();
    const auto close = [questions = questions_](const void* question) {
      const std::lock_guard lock(questions->mutex);
      questions->open.erase(question);
    };
    const std::lock_guard lock(questions_->mutex);
    Question* const question = begun->get();
    questions_->open.emplace(question, std::move(*begun));
    asking = std::shared_ptr<void>(question, close);
  }
  Question& question = *static_cast<Question*>(asking.get());
  const auto reply = question.endpoints->Take();
  if (!reply) return std::optional<std::string>();
  bool is_done = false;
  std::string said, token;
  auto from = CdrReader::Begin(reply->message);
  if (!from || !from->Get(is_done) || !from->GetText(said) || !from->GetText(token)) {
    return Error{.message = name + " answers by what cannot be read"};
  }
  if (!token.empty()) {
    if (std::exchange(question.has_token, true)) return std::optional<std::string>();  // there are two of this name
    if (SteadyClock().Now() - question.begun > kTokenLife)
      return Error{.message = name + " has answered too late: nothing has been done"};
    if (const auto sent = Send(question, token); !sent) return sent.error();
    return std::optional<std::string>();
  }
  while (said.ends_with('\n')) said.pop_back();
  if (is_done) return std::optional(name + ": " + said + "\n");
  return Error{.message = name + " says: " + said};
}

Result<std::unique_ptr<ApplicationCommands::Question>> ApplicationCommands::Begin(const std::string& name,
                                                                                  const std::string& path,
                                                                                  const Change& change) {
  const auto members = link_.table().members();
  const auto found = std::ranges::find(members, name, &WireMember::name);
  if (found == members.end()) {
    const auto names = NamesOf(members, [](const WireMember& each) { return "//" + each.name; });
    return Error{
        .message = "no //" + name + " is in the network", .path = path, .hint = NearestNameHint("//" + name, names)};
  }
  const std::string command = CommandOf(change);
  if (!Allows(found->user_data, command)) {
    return Error{.message = name + " does not let others " + command + " anything",
                 .path = path,
                 .hint = "<network commands=\"" + command + "\"> in its file would"};
  }
  auto endpoints = Open(ServiceEndpoints::Side::kClient, name, [] {});
  if (!endpoints) return endpoints.error();
  auto question = std::make_unique<Question>(Question{std::move(*endpoints), ChangeText(change), SteadyClock().Now()});
  // Not for who is started in its place: that one is asked again, or not. One that was killed is in the table until its lease is over.
  std::string whom;
  for (const WireMember& each : members) whom += each.name == name ? TextOf(each.id) : "";
  if (const auto asked = Send(*question, whom); !asked) return asked.error();
  return question;
}

Result<std::int64_t> ApplicationCommands::Send(const Question& question, const std::string& whom) {
  Octets octets;
  CdrWriter to(octets);
  to.PutText("//" + element_.options().member.name);
  to.PutText(question.change);
  to.PutText(whom);
  return question.endpoints->Request(octets);
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

// By threads of the engine, and by the worker when something has been done.
void ApplicationCommands::Serve() {
  const std::lock_guard lock(mutex_);
  if (offered_ == nullptr) return;
  while (const auto request = offered_->Take()) {
    // One comes again where the link was lost meanwhile.
    if (std::ranges::find(known_, request->id) != known_.end()) continue;
    known_.push_back(request->id);
    if (known_.size() > kMostErrands) known_.pop_front();
    Begin(*request);
  }
  EraseWhere(errands_, [&](Errand& each) {
    if (!each.command->is_done()) return false;
    const CommandAnswer answer = each.command->Take();
    if (answer) element_.log().Info("{}", each.text);
    Reply(each.id, answer);
    return true;
  });
}

void ApplicationCommands::Begin(const ServiceMessage& request) {
  std::string who, change, whom;
  auto from = CdrReader::Begin(request.message);
  if (!from || !from->GetText(who) || !from->GetText(change) || !from->GetText(whom)) {
    return Reply(request.id, CommandAnswer::Refused({.message = "the request cannot be read: nothing has been done"}));
  }
  who = Printable(who);
  const std::string own = TextOf(link_.participant().id());
  if (whom.find(own) == std::string::npos) return;
  const Duration now = SteadyClock().Now().time_since_epoch();
  const std::string token = own + ":";
  if (!whom.starts_with(token)) {
    const auto is_meant = element_.runtime().robot_stop().CheckIsKnown({.asked = request.sent, .requests = {}});
    if (!is_meant) return Reply(request.id, CommandAnswer::Refused(is_meant.error()));
    const Error other{.message = "both must be of one version of Runnel"};  // for who knows no token
    return Reply(request.id, CommandAnswer::Failed(other), token + std::to_string(now.count()));
  }
  const Duration given(NumberIn<std::int64_t>(whom.substr(token.size())).value_or(0));
  if (given > now || given <= now - kTokenLife) {
    return Reply(request.id, CommandAnswer::Refused({.message = "it came too late: nothing has been done"}));
  }
  Diagnostics diagnostics;
  PlacedChanges placed = ParseChanges(change, {}, diagnostics);
  if (const auto why = WhyRefused(placed.changes)) diagnostics.Add(*why);
  // They are seen from the application, whatever it is called here.
  for (Change& each : placed.changes) {
    if (std::string* const path = PathOf(each)) *path = application_ + *path;
  }
  if (!diagnostics.ok() || placed.changes.size() != 1) {
    return Reply(request.id,
                 {.outcome = CommandAnswer::Outcome::kRefused, .text = {}, .diagnostics = diagnostics, .needs = {}});
  }
  if (errands_.size() >= kMostErrands) {
    return Reply(request.id, CommandAnswer::Failed({.message = "too much has been asked for already"}));
  }
  std::string text = ChangeText(placed.changes.front());
  errands_.push_back({request.id, who + " has it done: " + text,
                      service_.Begin(ChangeRequest{.placed = std::move(placed), .client = who}, tasks_,
                                     [this] { Serve(); }, {.asked = Time(given), .requests = {}})});
}

void ApplicationCommands::Reply(const CallId& id, const CommandAnswer& answer, const std::string& token) {
  std::string text = answer ? answer.text : "";
  for (const Error& each : answer.diagnostics.errors()) text += (text.empty() ? "" : "\n") + each.ToString();
  Octets octets;
  CdrWriter to(octets);
  to.Put(static_cast<bool>(answer));
  to.PutText(text);
  to.PutText(token);
  (void)offered_->Reply(id, octets);
}

}  // namespace runnel
