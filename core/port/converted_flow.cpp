#include "core/port/converted_flow.h"

#include <algorithm>
#include <atomic>
#include <utility>

#include "core/base/retry.h"
#include "core/channel/channel_base.h"
#include "core/channel/probe_queue.h"
#include "core/element/runtime.h"
#include "core/lockfree/taking_turns.h"
#include "core/lockfree/thread_epoch.h"
#include "core/port/input_base.h"
#include "core/port/stand_in.h"

namespace runnel::internal {

namespace {

// A publisher takes out at once what it has put in; more wait only while somebody connects.
constexpr std::size_t kWaiting = 8;

}  // namespace

/// What publishers find.
class ConvertedFlow::Worker final : public Waker {
 public:
  Worker(std::shared_ptr<const Conversion> conversion, ChannelBase& channel)
      : conversion_(std::move(conversion)), channel_(channel), queue_(kWaiting) {}

  [[nodiscard]] ProbeQueue& queue() noexcept { return queue_; }
  [[nodiscard]] std::uint64_t failures() const noexcept {
    return failures_.load(std::memory_order_relaxed);  // a statistic
  }

  void Wake() noexcept override {
    turns_.Do([this]() noexcept {
      while (queue_.TryTake([this](const void* value, const Publication& publication, std::uint64_t source) {
        Convert(value, publication, source);
      })) {
      }
    });
  }

 private:
  void Convert(const void* value, const Publication& publication, std::uint64_t source) noexcept {
    // One that was there when the link was made may have come twice. Another channel counts from 1 again.
    if (std::exchange(last_source_, source) != source) last_ = 0;
    if (publication.sequence <= last_) return;
    last_ = publication.sequence;
    struct Filling {
      const Conversion& conversion;
      const void* value;
    } filling{*conversion_, value};
    bool is_published = false;
    try {
      const auto convert = [](void* context, void* result) {
        const auto& by = *static_cast<Filling*>(context);
        return by.conversion(by.value, result);
      };
      const auto published = channel_.PublishFilled(convert, &filling, ValueTimes::Of(publication));
      is_published = published && *published != PublishStatus::kNoBuffer;
    } catch (...) {  // no memory for one more buffer
    }
    if (!is_published) failures_.fetch_add(1, std::memory_order_relaxed);
  }

  const std::shared_ptr<const Conversion> conversion_;
  ChannelBase& channel_;
  ProbeQueue queue_;
  TakingTurns<> turns_;
  // Of whose turn it is.
  std::uint64_t last_ = 0;
  std::uint64_t last_source_ = 0;
  std::atomic<std::uint64_t> failures_{0};
};

class ConvertedFlow::LinkInput final : public InputBase {
 public:
  LinkInput(const Port& source, Worker& worker)
      : InputBase({source.runtime().root(), "converted", false}, source.type(), {}), worker_(worker) {
    SetWaker(&worker_);
  }
  using InputBase::sources;
  void Take(Port* source) { Rebind(source != nullptr ? std::vector<Source>{{source, {}}} : std::vector<Source>{}); }
  [[nodiscard]] bool Takes(const Port& source) const noexcept {
    return !sources().empty() && sources().front().output == &source;
  }
  /// `source` may have got another channel.
  void Follow(Port& source) {
    if (ChannelOf(source) != channel_) Take(&source);
  }

 private:
  [[nodiscard]] std::uint64_t dropped() const noexcept override { return worker_.queue().dropped(); }
  QueueSink* Bind(const std::vector<Source>& sources) override { return sources.empty() ? nullptr : &worker_.queue(); }
  void TakeOverBinding(InputBase&) noexcept override {}
  // By then its publishers know of it; what fails before that is done again by Follow().
  void Bound() override {
    channel_ = sources().empty() ? nullptr : ChannelOf(*sources().front().output);
    if (channel_ == nullptr) return;
    const EpochGuard guard;
    channel_->DeliverNewest(worker_.queue());
  }
  [[nodiscard]] bool HasNew() const override { return worker_.queue().HasNext(); }

  Worker& worker_;
  ChannelBase* channel_ = nullptr;
};

// What publishers may still be in, and viewers may look at, for a while after it has gone.
struct ConvertedFlow::Link {
  Link(const ConvertedFlow& flow, const Port& source, std::unique_ptr<ChannelBase> channel)
      : output(flow.target(), std::move(channel)),
        worker(flow.conversion_, output.own_channel()),
        input(source, worker) {}
  StandIn output;
  Worker worker;
  LinkInput input;
};

ConvertedFlow::ConvertedFlow(std::shared_ptr<const Conversion> conversion, const Port& target, AnyValue first)
    : conversion_(std::move(conversion)), first_(std::move(first)), target_(&target) {}

ConvertedFlow::~ConvertedFlow() { KeepOnly({}); }

void ConvertedFlow::set_target(const Port& target) noexcept {
  target_ = &target;
  for (const auto& link : links_) link->output.set_goes_on_at(target);
}

std::uint64_t ConvertedFlow::failures() const noexcept {
  std::uint64_t sum = 0;
  for (const auto& link : links_) sum += link->worker.failures();
  return sum;
}

Port* ConvertedFlow::OutputFor(Port& source, bool makes) {
  for (const auto& link : links_) {
    if (!link->input.Takes(source)) continue;
    if (makes) link->input.Follow(source);
    return &link->output;
  }
  if (!makes) return nullptr;
  auto channel = MakeChannelFor(target_->type());
  if (!channel) return nullptr;
  links_.push_back(std::make_unique<Link>(*this, source, std::move(channel)));
  // Before its source can publish.
  if (first_) (void)links_.back()->output.PublishFilled(FillWith(first_));
  // Publishers are told of it as one of the source's sinks.
  links_.back()->input.Take(&source);
  return &links_.back()->output;
}

bool ConvertedFlow::Makes(const Port& output) const noexcept {
  return std::ranges::any_of(links_, [&](const auto& link) { return &link->output == &output; });
}

Port* ConvertedFlow::InputFor(const Port& source) const noexcept {
  for (const auto& link : links_) {
    if (link->input.Takes(source)) return &link->input;
  }
  return nullptr;
}

void ConvertedFlow::KeepOnly(const std::vector<Port*>& sources) {
  const auto stays = [&](const std::unique_ptr<Link>& link) {
    return std::ranges::any_of(sources, [&](const Port* source) { return link->input.Takes(*source); });
  };
  const auto first = std::stable_partition(links_.begin(), links_.end(), stays);
  const auto kept = static_cast<std::size_t>(first - links_.begin());
  while (links_.size() > kept) {
    // Out of the list first: publishers are told then of whom they find in it.
    Link* const ended = links_.back().release();
    links_.pop_back();
    // Nobody reads from its channel any more.
    Retry([&] { ended->input.Take(nullptr); });
    Retire([ended] { delete ended; });
  }
}

Result<std::shared_ptr<const Conversion>> ConversionBetween(const Port& from, const Port& to, const std::string& part,
                                                            const std::string& name) {
  const bool is_one_unit = from.unit().empty() || to.unit().empty() || from.unit() == to.unit();
  if (&from.type() == &to.type() && part.empty() && name.empty() && is_one_unit) {
    return std::shared_ptr<const Conversion>();
  }
  return Conversion::Find({from.type(), to.type(), part, name, from.unit(), to.unit()});
}

}  // namespace runnel::internal
