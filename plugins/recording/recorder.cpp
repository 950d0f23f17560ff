#include "plugins/recording/recorder.h"

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <ctime>
#include <utility>

#include <fmt/chrono.h>

#include "core/base/nearest_name.h"
#include "core/element/attempt.h"
#include "core/element/file_notes.h"
#include "core/types/type_info.h"
#include "plugins/mcap/compression.h"
#include "plugins/mcap/mcap_writer.h"
#include "plugins/recording/recording_names.h"
#include "plugins/scheduling/scheduler.h"

namespace runnel {

namespace {

constexpr std::size_t kMostWaitingMessages = 10'000;

/// Below which the probes of a recorder are. Beside the tree: no part of the application, so that nobody
/// finds or saves it, and modules need not be held back when it goes.
class RecorderElement final : public FrameworkElement {
 public:
  explicit RecorderElement(FrameworkElement& root) : FrameworkElement(Placement{root, "recorder", false}) {
    Annotate(std::make_unique<NotSaved>());
  }
};

bool Feeds(const Port& port, const FrameworkElement& below) {
  return std::ranges::any_of(port.outgoing(), [&](const Connection& each) { return each.to->IsAtOrBelow(below); });
}

std::vector<Port*> PortsWithin(FrameworkElement& element) {
  std::vector<Port*> ports;
  element.Visit([&](FrameworkElement& each) {
    if (auto* const port = dynamic_cast<Port*>(&each)) ports.push_back(port);
  });
  return ports;
}

Result<std::string> ChooseCompression(const std::string& request) {
  if (request.empty()) return Compressions().front();
  const std::string chosen = request == "none" ? "" : request;
  if (auto known = CheckCompression(chosen); !known) return known.error();
  return chosen;
}

}  // namespace

Result<std::unique_ptr<Recorder>> Recorder::Start(Runtime& runtime, Scheduler* scheduler, RecorderOptions options) {
  auto patterns = PortPatterns::Make(options.ports);
  if (!patterns) return patterns.error();
  const auto compression = ChooseCompression(options.compression);
  if (!compression) return compression.error();
  options.compression = *compression;
  std::unique_ptr<Recorder> recorder(new Recorder(runtime, scheduler, std::move(options), std::move(*patterns)));
  if (auto begun = Attempt([&] { return recorder->Begin(); }, "the recording could not begin: "); !begun) {
    return begun.error();
  }
  return recorder;
}

Recorder::Recorder(Runtime& runtime, Scheduler* scheduler, RecorderOptions options, PortPatterns patterns)
    : runtime_(runtime), scheduler_(scheduler), options_(std::move(options)), patterns_(std::move(patterns)) {
  for (const std::string& pattern : patterns_.texts()) {
    if (!pattern.starts_with('!')) status_.idle_patterns.push_back(pattern);
  }
}

Recorder::~Recorder() {
  try {
    (void)Finish();
  } catch (...) {  // memory is short: nothing may be left that knows this
    EndWriting();
  }
  if (writer_ != nullptr && !has_begun_) std::remove(options_.file.c_str());
}

Result<void> Recorder::Begin() {
  {
    const std::lock_guard lock(runtime_.structure_mutex());
    if (auto checked = CheckNames(); !checked) return checked;
  }
  auto writer = McapWriter::Create(options_.file, {.header = McapHeader{"", "runnel " + options_.about.version},
                                                   .compression = options_.compression});
  if (!writer) return writer.error();
  writer_ = std::move(*writer);
  if (auto written = WriteAbout(); !written) return written;
  last_flush_ = std::chrono::steady_clock::now();
  {
    // One change: nobody publishes to some of the probes only.
    const ChangeScope changes(runtime_);
    element_ = std::make_unique<RecorderElement>(runtime_.root());
    for (Port* const each : PortsWithin(runtime_.root())) Follow(*each);
    ShowWhereTheRobotIs();
    runtime_.AddListener(*this);
  }
  if (scheduler_ != nullptr) scheduler_->backpressure().Add(*this);
  log_sink_.emplace(runtime_, [this](const LogMessage& message) { Keep(message); });
  thread_ = std::thread([this] { Write(); });
  has_begun_ = true;
  return {};
}

// A port that is named is meant; one that only fits a pattern is taken as it is.
Result<void> Recorder::CheckNames() {
  std::vector<std::string> paths;
  const std::vector<Port*> ports = PortsWithin(runtime_.root());
  for (const Port* const port : ports) {
    if (!port->is_proxy() && port->direction() != Port::Direction::kOutput) continue;
    paths.push_back(PlainPortPath(port->path()));
    paths.push_back(TopicOf(*port));
  }
  for (const std::string& name : patterns_.Names()) {
    const auto one = PortPatterns::Make({name});
    const auto meant = std::ranges::find_if(ports, [&](const Port* port) { return one->Fit(port->path()); });
    if (meant == ports.end()) {
      return Error{.message = "there is no port '" + name + "' to record", .hint = NearestNameHint(name, paths)};
    }
    const auto sender = std::ranges::find_if(ports, [&](const Port* port) {
      return one->Fit(port->path()) && (port->is_proxy() || port->direction() == Port::Direction::kOutput);
    });
    if (sender == ports.end()) {
      const auto sources = (*meant)->Sources();
      return Error{
          .message = "is an input; recorded is what outputs publish",
          .path = (*meant)->path(),
          .hint = sources.empty() ? "nothing is connected to it" : "record " + PlainPortPath(sources.front()->path())};
    }
    if (!(*sender)->type().is_transparent()) {
      return Error{
          .message = "values of type " + (*sender)->type().name() + " have no form in which they could be recorded",
          .path = (*sender)->path()};
    }
  }
  return {};
}

Result<void> Recorder::WriteAbout() {
  const RecordedApplication& about = options_.about;
  const bool is_simulated =
      scheduler_ != nullptr && scheduler_->options().clock == SchedulerOptions::ClockKind::kSimulated;
  std::string ports;
  for (const std::string& each : patterns_.texts()) ports += (ports.empty() ? "" : " ") + each;
  const McapMetadata metadata{kAboutMetadata,
                              {{"application", about.name},
                               {"file", about.file},
                               {"settings", about.settings},
                               {"clock", is_simulated ? "simulated" : "real"},
                               {"version", about.version},
                               {"ports", ports},
                               {"started", fmt::format("{:%Y-%m-%dT%H:%M:%SZ}", fmt::gmtime(std::time(nullptr)))}}};
  if (auto written = writer_->AddMetadata(metadata); !written) return written;
  if (about.text.empty()) return {};
  return writer_->AddAttachment({0, 0, kApplicationAttachment, "application/xml", about.text});
}

Result<void> Recorder::Finish() {
  // Destroyed after the mutex is free: cutting their connections takes the structure lock.
  std::vector<std::shared_ptr<Recorded>> ended;
  if (!std::exchange(has_finished_, true)) {
    if (scheduler_ != nullptr) scheduler_->backpressure().Remove(*this);
    runtime_.RemoveListener(*this);
    log_sink_.reset();  // hands on what has been said so far
    DisconnectProbes();
    EndWriting();
    const std::lock_guard lock(mutex_);
    for (const auto& each : recorded_) status_.dropped += each->dropped() + each->probe->waiting();
    ended.swap(recorded_);
  }
  const std::lock_guard lock(mutex_);
  return status_.failure ? Result<void>(*status_.failure) : Result<void>();
}

void Recorder::DisconnectProbes() {
  for (std::size_t i = 0;; ++i) {
    std::shared_ptr<Recorded> recorded;
    {
      const std::lock_guard lock(mutex_);
      is_finishing_ = true;
      if (i >= recorded_.size()) return;
      recorded = recorded_[i];
    }
    recorded->probe->DisconnectAll();
  }
}

void Recorder::EndWriting() noexcept {
  is_ending_ = true;
  Wake();
  if (thread_.joinable()) thread_.join();
}

void Recorder::Keep(const LogMessage& message) {
  const std::lock_guard lock(mutex_);
  if (said_.size() < kMostWaitingMessages) {
    said_.push_back(message);
  } else {
    ++lost_messages_;
  }
}

void Recorder::Wake() noexcept {
  {
    const std::lock_guard lock(wake_mutex_);
    is_woken_ = true;
  }
  wake_.notify_one();
}

RecordingStatus Recorder::status() const {
  const std::lock_guard lock(mutex_);
  RecordingStatus status = status_;
  for (const auto& each : recorded_) status.dropped += each->dropped();
  return status;
}

std::optional<Error> Recorder::TakeFailure() {
  const std::lock_guard lock(mutex_);
  if (status_.failure && !std::exchange(failure_is_told_, true)) return status_.failure;
  if (status_.unwritable && !std::exchange(unwritable_is_told_, true)) return status_.unwritable;
  return {};
}

std::vector<std::shared_ptr<Recorder::Recorded>> Recorder::All() const {
  const std::lock_guard lock(mutex_);
  return recorded_;
}

bool Recorder::IsRecorded(const Port& port) {
  // Interface ports only pass on: only who names one wants it.
  if (port.is_proxy()) return patterns_.Name(port.path());
  return port.direction() == Port::Direction::kOutput && patterns_.Fit(port.path());
}

void Recorder::Follow(Port& port, const Recorded* before) {
  if ((before == nullptr && !IsRecorded(port)) || port.IsAtOrBelow(*element_) || Feeds(port, *element_)) return;
  NoteUse(port);
  if (!port.type().is_transparent()) {
    const std::lock_guard lock(mutex_);
    if (std::ranges::count(status_.left_out, port.path()) == 0) {
      status_.left_out.push_back(port.path());
    }
    return;
  }
  auto recorded = std::make_shared<Recorded>();
  recorded->path = port.path();
  recorded->type = &port.type();
  recorded->probe =
      std::make_unique<ProbePort>(*element_, "probe_" + std::to_string(++made_probes_), port.type(), options_.capacity);
  recorded->forms = ChannelsFor(port.type(), TopicOf(port), WholeValues());
  const bool has_transform = before != nullptr && before->forms.size() > recorded->forms.size();
  if (has_transform) recorded->forms.push_back(before->forms.back());
  if (const auto connected = Port::Connect(port, *recorded->probe); !connected) {
    if (port.life_cycle() == LifeCycle::kDeleted) return;
    throw ElementError(connected.error());
  }
  const std::lock_guard lock(mutex_);
  recorded_.push_back(std::move(recorded));
  ++status_.ports;
}

void Recorder::NoteUse(const Port& port) {
  const std::lock_guard lock(mutex_);
  std::erase_if(status_.idle_patterns, [&](const std::string& pattern) {
    const auto one = PortPatterns::Make({pattern});
    return one && one->Fit(port.path());
  });
}

// The poses of the port that says it, as the transform that scans are drawn by.
void Recorder::ShowWhereTheRobotIs() {
  const std::vector<Port*> ports = PortsWithin(runtime_.root());
  const Port* const pose = RobotPose({ports.begin(), ports.end()});
  if (pose == nullptr) return;
  const auto transform = TransformChannelFor(pose->type());
  for (const auto& each : All()) {
    if (transform && each->path == pose->path()) each->forms.push_back(*transform);
  }
}

void Recorder::OnReady(FrameworkElement& element) {
  if (has_failed_) return;
  has_new_names_ = true;
  try {
    for (Port* const each : PortsWithin(element)) Follow(*each);
  } catch (...) {  // the recording would lack something; the change of the structure is none of its business
    NoteException();
  }
}

// What has another name now goes on as what it is called, from its next value on.
void Recorder::OnChangesEnd() {
  if (!std::exchange(has_new_names_, false) || has_failed_) return;
  try {
    for (const auto& each : All()) {
      if (each->probe->incoming().empty()) continue;
      Port& port = *each->probe->incoming().front();
      if (port.life_cycle() == LifeCycle::kDeleted || port.path() == each->path) continue;
      each->probe->DisconnectAll();
      has_gone_ = true;
      Follow(port, each.get());
    }
  } catch (...) {
    NoteException();
  }
}

void Recorder::WaitForRoom() noexcept {
  const auto is_behind = [this] {
    const std::lock_guard lock(mutex_);
    return std::ranges::any_of(recorded_,
                               [](const auto& each) { return each->probe->waiting() * 2 > each->probe->capacity(); });
  };
  while (!has_failed_ && is_behind()) {
    Wake();
    std::this_thread::sleep_for(std::chrono::microseconds(100));
  }
}

}  // namespace runnel
