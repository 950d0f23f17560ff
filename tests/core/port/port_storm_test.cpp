// Everything at once: ports come and go, connections and the lengths of queues change, while others
// publish, read, take, copy leases, hand them on and keep them. What is checked holds at any
// interleaving; most is found under ThreadSanitizer and AddressSanitizer.

#include <array>
#include <atomic>
#include <map>
#include <mutex>
#include <random>
#include <thread>

#include "plugins/real_time_check/sanitizer.h"
#include "tests/core/port/port_fixture.h"
#include "tests/support/threads.h"

namespace runnel::test {
namespace {

constexpr int kStormRounds = RUNNEL_UNDER_SANITIZER ? 1000 : 10000;

// A value says who published it and as how manyth, several times over.
struct SmallStormValue {
  std::uint32_t source = 0, number = 0, check = 0;
};
struct MiddleStormValue {  // in buffers, but copied in queues
  std::uint32_t source = 0, number = 0;
  std::array<std::uint32_t, 30> checks{};
};
struct Living {
  Living() { ++count; }
  Living(const Living&) { ++count; }
  Living& operator=(const Living&) = default;
  ~Living() { --count; }
  static inline std::atomic<int> count{0};
};
struct ListStormValue {
  std::uint32_t source = 0, number = 0;
  std::vector<std::uint32_t> checks;
  Living living;
};
struct MovedStormValue {
  std::uint32_t source = 0, number = 0;
  std::unique_ptr<std::uint32_t> check;
  Living living;
};
void Describe(TypeBuilder<SmallStormValue>& type) { type.Name("test::SmallStormValue"); }
void Describe(TypeBuilder<MiddleStormValue>& type) { type.Name("test::MiddleStormValue"); }
void Describe(TypeBuilder<ListStormValue>& type) { type.Name("test::ListStormValue"); }
void Describe(TypeBuilder<MovedStormValue>& type) { type.Name("test::MovedStormValue"); }

std::uint32_t CheckOf(std::uint32_t source, std::uint32_t number) { return source * 2654435761u ^ number; }
void Seal(SmallStormValue& value) { value.check = CheckOf(value.source, value.number); }
void Seal(MiddleStormValue& value) { value.checks.fill(CheckOf(value.source, value.number)); }
void Seal(ListStormValue& value) { value.checks.assign(value.number % 40, CheckOf(value.source, value.number)); }
void Seal(MovedStormValue& value) {
  value.check = std::make_unique<std::uint32_t>(CheckOf(value.source, value.number));
}
bool IsWhole(const SmallStormValue& value) { return value.check == CheckOf(value.source, value.number); }
template <typename T>
bool AllEqual(const T& checks, std::uint32_t check) {
  return std::ranges::all_of(checks, [check](std::uint32_t each) { return each == check; });
}
bool IsWhole(const MiddleStormValue& value) { return AllEqual(value.checks, CheckOf(value.source, value.number)); }
bool IsWhole(const ListStormValue& value) {
  return value.checks.size() == value.number % 40 && AllEqual(value.checks, CheckOf(value.source, value.number));
}
bool IsWhole(const MovedStormValue& value) {
  return value.check && *value.check == CheckOf(value.source, value.number);
}

/// One storm over values of type T. Sources 1 and 2 stay; others come and go. Two of the inputs stay
/// connected to both: `refusing`, from which nothing may be missing, and `dropping`, from which as
/// much may be missing as it has counted. A third one is connected anew all the time.
template <typename T>
class Storm {
 public:
  void Rage() {
    Connect(*stays_[0], refusing_, Refusing(8));
    Connect(*stays_[1], refusing_, Refusing(8));
    for (auto* stays : stays_) Connect(*stays, dropping_, {.queue = 3});
    RunTogether(8, [this](unsigned index) {
      switch (index) {
        case 0:
        case 1:
          return Publish(index);
        case 2:
          return Guard([this] { TakeAllThatCannotBeRefused(); });
        case 3:
          return Guard([this] { TakeFromDropping(); });
        case 4:
          return Guard([this] { ReadWandering(); });
        case 5:
          return Guard([this] { KeepAndHandOn(); });
        case 6:
          return ChangeConnections();
        default:
          return LetPortsComeAndGo();
      }
    });
    TakeAllThatCannotBeRefused();
    EXPECT_EQ(broken_, 0) << "values that are not whole";
    EXPECT_EQ(backward_, 0) << "a reader saw an older value after a newer one";
    EXPECT_EQ(missing_, 0) << "values missing from a queue that refuses, or there twice";
    EXPECT_LE(lost_, dropping_.dropped()) << "values missing from a queue that drops, uncounted";
    for (unsigned i = 0; i < 2; ++i) {
      EXPECT_EQ(last_taken_[i], accepted_[i]) << "the last values of source " << i + 1;
      EXPECT_GT(accepted_[i], 0u);
      EXPECT_LE(stays_[i]->growths(), 12u);
    }
    EXPECT_GT(wandering_reads_, 0);
    // A reader that the machine stops inside a guard holds up some; all of them would be many more.
    EXPECT_LT(replaced_, kStormRounds / 2u) << "queues that have been replaced and are still there";
  }

  /// What leases kept beyond the storm and its ports hold.
  std::vector<Lease<T>> kept;

 private:
  static ConnectOptions Refusing(std::size_t queue) { return {.queue = queue, .on_full = OnFull::kRefuse}; }
  static void Connect(Port& from, Port& to, const ConnectOptions& options) {
    const auto connected = Port::Connect(from, to, options);
    ASSERT_TRUE(connected) << connected.error().ToString();
  }
  template <typename Body>
  void Guard(const Body& body) {
    while (!calm_) {
      body();
      MaybeYield();
    }
  }
  PublishStatus PublishOne(Output<T>& output, std::uint32_t source, std::uint32_t number) {
    auto loan = output.Loan();
    if (!loan) return PublishStatus::kNoBuffer;
    loan->source = source;
    loan->number = number;
    Seal(*loan);
    return output.Publish(std::move(loan));
  }

  // What has been refused is published again, which may then be twice in queues that took it: in
  // `refusing_`, which alone refuses, each number comes once.
  void Publish(unsigned index) {
    auto& output = *stays_[index];
    std::mt19937 random(index);
    std::uint32_t number = 0;
    while (changing_ > 0) {
      { const auto unpublished = output.Loan(); }
      if (PublishOne(output, index + 1, number + 1) == PublishStatus::kPublished) {
        ++number;
      } else {
        std::this_thread::yield();
      }
      if (random() % 16 == 0) std::this_thread::yield();
    }
    accepted_[index] = number;
    if (--publishing_ == 0) calm_ = true;
  }
  void TakeAllThatCannotBeRefused() {
    (void)refusing_.Drain([this](const Lease<T>& lease) {
      Check(*lease);
      if (lease->source > 2) return;
      std::uint32_t& last = last_taken_[lease->source - 1];
      if (lease->number != last + 1) ++missing_;
      last = lease->number;
    });
  }
  void TakeFromDropping() {
    const Lease<T> lease = dropping_.Take();
    if (!lease) return;
    Check(*lease);
    if (lease->source > 2) return;
    lost_ += lease.missed();
    CheckOrder(*lease, last_dropping_);
  }
  void ReadWandering() {
    const Lease<T> newest = wandering_.Read();
    if (newest) {
      Check(*newest);
      CheckOrder(*newest, last_wandering_);
      ++wandering_reads_;
    }
    if constexpr (std::is_trivially_copyable_v<T>) Check(wandering_.Get(Initial()));
    (void)wandering_.Drain([this](const Lease<T>& lease) { Check(*lease); });
    (void)wandering_.publications();
    (void)wandering_.dropped();
  }
  // More leases than a thread has slots, copied, given to whoever comes next, kept for the end.
  void KeepAndHandOn() {
    std::vector<Lease<T>> held;
    for (int i = 0; i < 10; ++i) {
      held.push_back(dropping_.Peek());
      if (!held.back()) held.pop_back();
      if (i % 3 == 0 && !held.empty()) held.push_back(held.front());
    }
    {
      const std::lock_guard lock(handed_mutex_);
      for (Lease<T>& lease : held) std::swap(lease, handed_[handed_next_++ % handed_.size()]);
    }
    for (const Lease<T>& lease : held) {
      if (lease) Check(*lease);
    }
    if (kept.size() < 20 && !held.empty() && held.back()) kept.push_back(held.back());
  }
  void DropOneHandedOn(std::size_t which) {
    Lease<T> dropped;
    {
      const std::lock_guard lock(handed_mutex_);
      std::swap(dropped, handed_[which % handed_.size()]);
    }
    if (dropped) Check(*dropped);
  }

  // Lengths and kinds of the queues that stay change by sources that come and go beside them.
  void ChangeConnections() {
    std::mt19937 random(6);
    auto& passing = runtime_.Create<Sender<T>>(runtime_.root(), "passing").out;
    std::uint32_t number = 0;
    for (int i = 0; i < kStormRounds; ++i) {
      const auto room = 1 + random() % 12;
      Connect(passing, refusing_, Refusing(room));
      Connect(passing, dropping_, {.queue = room});
      Connect(*stays_[i % 2], wandering_, {.queue = random() % 4, .on_full = OnFull::kDropNewest});
      // What it publishes is in nobody's count of missing values, and takes its share of the room.
      if (PublishOne(passing, 3, ++number) == PublishStatus::kNoBuffer) ++missing_;
      DropOneHandedOn(random());
      for (Input<T>* input : {&refusing_, &dropping_}) {
        EXPECT_TRUE(Port::Disconnect(passing, *input));
        replaced_ = std::max(replaced_, input->replaced_queues());
      }
      EXPECT_TRUE(Port::Disconnect(*stays_[i % 2], wandering_));
    }
    --changing_;
  }
  void LetPortsComeAndGo() {
    std::mt19937 random(7);
    for (int i = 0; i < kStormRounds / 2; ++i) {
      const auto source = static_cast<std::uint32_t>(4 + i);
      auto& sender =
          runtime_.Create<Sender<T>>(runtime_.root(), "sender", OutputOptions{.pool = {.buffers = 1 + source % 4}});
      auto& receiver = runtime_.Create<Receiver<T>>(runtime_.root(), "receiver");
      (void)PublishOne(sender.out, source, 1);
      Connect(sender.out, wandering_, {.queue = random() % 3});
      Connect(sender.out, receiver.in, {.queue = 2});
      Connect(*stays_[i % 2], receiver.in, {});
      for (std::uint32_t number = 2; number < 6; ++number) {
        (void)PublishOne(sender.out, source, number);
      }
      const Lease<T> lease = receiver.in.Read();
      const Lease<T> taken = receiver.in.Take();
      auto loan = sender.out.Loan();
      FrameworkElement* const in_turn[] = {&receiver, &sender};
      EXPECT_TRUE(runtime_.Delete(*in_turn[i % 2]));
      EXPECT_TRUE(runtime_.Delete(*in_turn[1 - i % 2]));
      for (const auto* each : {&lease, &taken}) {
        if (*each) Check(**each);
      }
      DropOneHandedOn(random());
    }
    --changing_;
  }

  static T Initial() requires(std::is_trivially_copyable_v<T>) {
    T value{};
    Seal(value);
    return value;
  }
  void Check(const T& value) {
    if (!IsWhole(value)) ++broken_;
  }
  void CheckOrder(const T& value, std::map<std::uint32_t, std::uint32_t>& last) {
    std::uint32_t& before = last[value.source];
    if (value.number < before) ++backward_;
    before = value.number;
  }

  Runtime runtime_;
  std::array<Output<T>*, 2> stays_{&runtime_.Create<Sender<T>>(runtime_.root(), "stays1").out,
                                   &runtime_.Create<Sender<T>>(runtime_.root(), "stays2").out};
  Input<T>& refusing_ = runtime_.Create<Receiver<T>>(runtime_.root(), "refusing").in;
  Input<T>& dropping_ = runtime_.Create<Receiver<T>>(runtime_.root(), "dropping").in;
  Input<T>& wandering_ = runtime_.Create<Receiver<T>>(runtime_.root(), "wandering").in;

  std::atomic<int> changing_{2}, publishing_{2};
  std::atomic<bool> calm_{false};
  std::atomic<int> broken_{0}, backward_{0}, missing_{0}, wandering_reads_{0};
  std::array<std::uint32_t, 2> accepted_{};
  std::array<std::uint32_t, 2> last_taken_{};
  std::map<std::uint32_t, std::uint32_t> last_dropping_, last_wandering_;
  std::uint64_t lost_ = 0;
  std::size_t replaced_ = 0;
  std::mutex handed_mutex_;
  std::array<Lease<T>, 32> handed_;
  std::size_t handed_next_ = 0;
};

template <typename T>
void RageAndLookAtWhatIsLeft() {
  const int before = Living::count;
  std::vector<Lease<T>> kept;
  {
    Storm<T> storm;
    storm.Rage();
    kept = std::move(storm.kept);
  }
  for (const Lease<T>& lease : kept) EXPECT_TRUE(IsWhole(*lease));
  kept.clear();
  WaitForReaders();
  EXPECT_EQ(Living::count, before) << "values were not destroyed, or twice";
}

TEST(PortStormTest, SmallValues) { RageAndLookAtWhatIsLeft<SmallStormValue>(); }
TEST(PortStormTest, ValuesInBuffersThatQueuesCopy) { RageAndLookAtWhatIsLeft<MiddleStormValue>(); }
TEST(PortStormTest, ValuesWithMemory) { RageAndLookAtWhatIsLeft<ListStormValue>(); }
TEST(PortStormTest, ValuesThatCanOnlyBeMoved) { RageAndLookAtWhatIsLeft<MovedStormValue>(); }

}  // namespace
}  // namespace runnel::test
