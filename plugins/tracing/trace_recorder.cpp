#include "plugins/tracing/trace_recorder.h"

#include <utility>

#include "core/base/error.h"
#include "core/plugin/module_type_name.h"
#include "core/port/port.h"
#include "plugins/tracing/internal/trace_writer.h"
#include "plugins/values/json_writer.h"

namespace runnel {

namespace {

constexpr std::size_t kMostSpans = 100'000;

std::string JsonText(std::string_view text) {
  std::string json;
  AppendJsonString(text, json);
  return json;
}

}  // namespace

Result<std::unique_ptr<TraceRecorder>> TraceRecorder::Start(Runtime& runtime, TraceOptions options) {
  auto file = TraceFile::Create(options.file, options.most_bytes);
  if (!file) return file.error();
  return std::unique_ptr<TraceRecorder>(new TraceRecorder(runtime, std::move(options), std::move(*file)));
}

TraceRecorder::TraceRecorder(Runtime& runtime, TraceOptions options, TraceFile file)
    : runtime_(runtime),
      options_(std::move(options)),
      writer_(std::make_unique<internal::TraceWriter>(std::move(file), options_.application, options_.is_simulated)) {
  runtime_.AddListener(*this);
  thread_ = std::thread([this] { Work(); });
}

TraceRecorder::~TraceRecorder() {
  if (thread_.joinable()) (void)Finish();
}

void TraceRecorder::FollowStructure() {
  const std::lock_guard lock(mutex_);
  follows_structure_ = true;
}

Result<TraceSummary> TraceRecorder::Finish() {
  runtime_.RemoveListener(*this);
  {
    const std::lock_guard lock(mutex_);
    ends_ = true;
  }
  end_.notify_one();
  if (thread_.joinable()) thread_.join();
  auto finished = writer_->Finish();
  if (failure_ == nullptr) return finished;
  return Error{.message = "the trace '" + options_.file + "' came to an early end: " + DescribeException(failure_)};
}

// Whatever goes wrong with the writing ends the trace and not the application.
void TraceRecorder::Work() noexcept {
  try {
    WriteUntilTheEnd();
  } catch (...) {
    failure_ = std::current_exception();
  }
}

void TraceRecorder::WriteUntilTheEnd() {
  std::unique_lock lock(mutex_);
  while (!end_.wait_for(lock, options_.interval, [this] { return ends_; })) {
    lock.unlock();
    writer_->Write(TakePending());
    lock.lock();
  }
  lock.unlock();
  writer_->Write(TakePending());
}

internal::PendingTrace TraceRecorder::TakePending() {
  const std::lock_guard lock(mutex_);
  return {std::exchange(new_threads_, {}), std::exchange(new_names_, {}), std::exchange(spans_, {}),
          std::exchange(lost_spans_, 0)};
}

TraceTrack& TraceRecorder::TrackOf(std::uint64_t id, const std::string& path) {
  const std::lock_guard lock(mutex_);
  for (const auto& each : threads_) {
    if (each->id == id) return each->track;
  }
  threads_.push_back(std::make_unique<internal::TracedThread>(id, JsonText(path), options_.capacity));
  new_threads_.push_back(threads_.back().get());
  return threads_.back()->track;
}

std::unique_ptr<TracedElement> TraceRecorder::Watch(FrameworkElement& element) {
  auto traced = std::make_unique<TracedElement>();
  const std::lock_guard lock(mutex_);
  traced->number = GiveNumber(element.path());
  for (FrameworkElement* group : element.children()) {
    if (group->kind() != ElementKind::kPortGroup) continue;
    for (FrameworkElement* each : group->children()) {
      const auto* const port = dynamic_cast<const Port*>(each);
      if (port == nullptr || port->is_proxy() || port->direction() != Port::Direction::kOutput) {
        continue;
      }
      traced->ports.push_back({port, GiveNumber("publish " + port->path()), port->publications()});
    }
  }
  return traced;
}

// Under the mutex.
std::uint64_t TraceRecorder::GiveNumber(const std::string& name) {
  new_names_.push_back(JsonText(name));
  return names_given_++;
}

std::uint64_t TraceRecorder::NumberOf(const std::string& name) {
  const std::lock_guard lock(mutex_);
  return GiveNumber(name);
}

void TraceRecorder::OnHold(const std::string& path, Time began, Time ended) noexcept {
  try {
    Add({"\"hold\"", "hold", began, ended, "\"thread\":" + JsonText(path)});
  } catch (...) {  // no memory
    const std::lock_guard lock(mutex_);
    ++lost_spans_;
  }
}

void TraceRecorder::Add(internal::TraceSpan span) {
  if (options_.is_simulated) {
    if (!span.arguments.empty()) span.arguments += ',';
    internal::AppendSimulatedTime(runtime_.clock().Now(), span.arguments);
  }
  const std::lock_guard lock(mutex_);
  if (ends_) return;
  if (spans_.size() < kMostSpans) {
    spans_.push_back(std::move(span));
  } else {
    ++lost_spans_;
  }
}

void TraceRecorder::AddChange(const std::function<std::string()>& words) noexcept {
  try {
    {
      const std::lock_guard lock(mutex_);
      if (!follows_structure_) return;
    }
    Add({JsonText(words()), "structure", SteadyClock().Now(), {}, {}});
  } catch (const std::bad_alloc&) {  // what has been done is done, whether it is in the trace or not
  }
}

void TraceRecorder::OnReady(FrameworkElement& element) {
  AddChange([&] {
    const std::string type = FindModuleType(element);
    return "put in " + element.path() + (type.empty() ? "" : " (" + type + ")");
  });
}

}  // namespace runnel
