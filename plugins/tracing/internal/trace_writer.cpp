#include "plugins/tracing/internal/trace_writer.h"

#include <algorithm>
#include <array>
#include <iterator>
#include <utility>

#include <fmt/format.h>

#include "plugins/values/json_writer.h"

namespace runnel::internal {

namespace {

// Where changes of the structure are shown; thread containers come after it.
constexpr int kChanges = 1;

Time TimeAt(std::int64_t count) { return Time(Duration(count)); }

// Of each Phase.
constexpr std::array kPhaseTexts{" sense", "", " control"};

}  // namespace

void AppendSimulatedTime(Time time, std::string& json) {
  const std::int64_t count = time.time_since_epoch().count();
  fmt::format_to(std::back_inserter(json), "\"simulated_s\":{}.{:09}", count / 1'000'000'000, count % 1'000'000'000);
}

TraceWriter::TraceWriter(TraceFile file, const std::string& application, bool is_simulated)
    : file_(std::move(file)), is_simulated_(is_simulated) {
  std::string name = "\"name\":";
  AppendJsonString("runnel " + application, name);
  file_.AddName(kChanges, "\"process_name\"", name);
  file_.AddName(kChanges, "\"thread_name\"", "\"name\":\"changes\"");
  file_.AddName(kChanges, "\"thread_sort_index\"", "\"sort_index\":1");
}

void TraceWriter::Introduce(TracedThread& thread) {
  const int track = kChanges + 1 + static_cast<int>(threads_.size());
  threads_.push_back({&thread, track});
  file_.AddName(track, "\"thread_name\"", "\"name\":" + thread.name);
  file_.AddName(track, "\"thread_sort_index\"", "\"sort_index\":" + std::to_string(track));
}

void TraceWriter::Write(PendingTrace pending) {
  for (TracedThread* thread : pending.threads) Introduce(*thread);
  for (std::string& name : pending.names) names_.push_back(std::move(name));
  for (const TraceSpan& each : pending.spans) {
    if (each.ended) {
      file_.AddSlice(kChanges, each.name, each.category, each.began, *each.ended, each.arguments);
    } else {
      file_.AddInstant(kChanges, each.name, each.category, each.began, each.arguments);
    }
  }
  TellOfLost(kChanges, pending.lost_spans);
  for (KnownThread& each : threads_) WriteEvents(each);
  file_.Flush();
}

// No more than a queue can hold, so that a thread that never rests does not keep the others waiting.
void TraceWriter::WriteEvents(KnownThread& known) {
  auto& events = known.thread->track.events();
  for (std::size_t left = events.read_available(); left > 0; --left) {
    const TraceEvent& event = events.front();
    using Kind = TraceEvent::Kind;
    constexpr std::array kNamed{Kind::kUpdate, Kind::kPublication, Kind::kFault, Kind::kArrow};
    const bool has_name = std::ranges::find(kNamed, event.kind) != kNamed.end();
    if (has_name && event.number >= names_.size()) break;
    WriteEvent(known, event);
    events.pop();
  }
  TellOfLost(known.track, known.thread->track.TakeLost());
}

void TraceWriter::WriteEvent(KnownThread& known, const TraceEvent& event) {
  using Kind = TraceEvent::Kind;
  if (event.kind == Kind::kText) {
    const auto* const bytes = reinterpret_cast<const char*>(event.words.data());
    if (known.fault) known.fault->message.append(bytes, event.length);
    return;
  }
  CloseFault(known);
  switch (event.kind) {
    case Kind::kCycle:
      return WriteCycle(known, event);
    case Kind::kUpdate:
      name_ = names_[event.number];
      name_.insert(name_.size() - 1, kPhaseTexts[static_cast<std::size_t>(event.phase)]);
      return file_.AddSlice(known.track, name_, "update", TimeAt(event.words[0]), TimeAt(event.words[1]), "");
    case Kind::kPublication:
      arguments_ = fmt::format("\"values\":{}", event.words[1]);
      return file_.AddInstant(known.track, names_[event.number], "publish", TimeAt(event.words[0]), arguments_);
    case Kind::kFault:
      known.fault = OpenFault{TimeAt(event.words[0]), names_[event.number], {}};
      return;
    case Kind::kArrow:
      return file_.AddArrow(known.track, names_[event.number],
                            std::array{'s', 't', 'f'}.at(static_cast<std::size_t>(event.words[1])),
                            TimeAt(event.words[0]), fmt::format("{}.{}", event.number, event.words[2]));
    case Kind::kText:
      return;
  }
}

void TraceWriter::WriteCycle(const KnownThread& known, const TraceEvent& event) {
  arguments_ = fmt::format("\"number\":{}", event.number);
  if (is_simulated_) {
    arguments_ += ',';
    AppendSimulatedTime(TimeAt(event.words[2]), arguments_);
  }
  file_.AddSlice(known.track, "\"cycle\"", "cycle", TimeAt(event.words[0]), TimeAt(event.words[1]), arguments_);
}

void TraceWriter::CloseFault(KnownThread& known) {
  if (!known.fault) return;
  arguments_ = "\"module\":" + known.fault->element + ",\"message\":";
  AppendJsonString(known.fault->message, arguments_);
  file_.AddInstant(known.track, "\"fault\"", "fault", known.fault->when, arguments_);
  known.fault.reset();
}

void TraceWriter::TellOfLost(int track, std::uint64_t lost) {
  if (lost == 0) return;
  lost_ += lost;
  file_.AddInstant(track, "\"lost events\"", "tracing", SteadyClock().Now(), fmt::format("\"count\":{}", lost));
}

Result<TraceSummary> TraceWriter::Finish() {
  for (KnownThread& each : threads_) CloseFault(each);
  file_.UseReserve();
  file_.AddInstant(kChanges, "\"end of the trace\"", "tracing", SteadyClock().Now(),
                   fmt::format("\"lost_events\":{},\"left_out_events\":{}", lost_, file_.left_out()));
  if (auto closed = file_.Close(); !closed) return closed.error();
  return TraceSummary{file_.events(), lost_, file_.left_out()};
}

}  // namespace runnel::internal
