#include "tests/support/fake_wire.h"

#include <algorithm>
#include <condition_variable>
#include <cstring>
#include <deque>
#include <map>
#include <mutex>
#include <set>
#include <thread>
#include <utility>

namespace runnel {

namespace {

class FakeParticipant;

struct FakeEndpoint {
  WireEndpoint about;
  FakeParticipant* participant;
  OnSample on_sample;
  OnMatched on_matched;
  std::size_t matched = 0;
  std::mutex mutex;
  std::set<std::uint64_t> others;  // at the other end, by their handles; guarded by mutex
  struct Value {
    std::shared_ptr<const Octets> octets;
    std::int64_t time;
    WireIdentity identity;
    WireIdentity related;
  };
  std::deque<Value> kept;  // by a latched writer

  void Take(const Value& value, std::uint64_t writer) const {
    CallBack([&] { on_sample({*value.octets, value.time, writer, value.identity, value.related}); });
  }
};

/// All of it is done by one thread, in the order in which it was asked for.
class FakeNetwork final : public WireEngine {
 public:
  FakeNetwork() : thread_([this] { Run(); }) {}
  ~FakeNetwork() override {
    {
      const std::lock_guard lock(mutex_);
      ends_ = true;
    }
    wake_.notify_all();
    thread_.join();
  }

  [[nodiscard]] bool has_identities() const noexcept override { return true; }
  Result<std::unique_ptr<WireParticipant>> Join(const WireMemberOptions& options, WireDiscovery& discovery) override;

  void Post(std::function<void()> task) {
    {
      const std::lock_guard lock(mutex_);
      tasks_.push_back(std::move(task));
    }
    wake_.notify_all();
  }
  void Do(const std::function<void()>& task) {
    std::mutex mutex;
    std::condition_variable done;
    bool is_done = false;
    Post([&] {
      task();
      const std::lock_guard lock(mutex);
      is_done = true;
      done.notify_all();
    });
    std::unique_lock lock(mutex);
    done.wait(lock, [&] { return is_done; });
  }
  WireId NewId() {
    const std::lock_guard lock(mutex_);
    WireId id{};
    ++made_;
    std::memcpy(id.data(), &made_, sizeof made_);
    return id;
  }

  // By its thread.
  void AddMember(FakeParticipant& member);
  void RemoveMember(FakeParticipant& member);
  void AddEndpoint(const std::shared_ptr<FakeEndpoint>& endpoint);
  void RemoveEndpoint(const std::shared_ptr<FakeEndpoint>& endpoint);
  void Deliver(FakeEndpoint& writer, const FakeEndpoint::Value& value);
  void SetCutOff(const std::string& name, bool is_cut_off, bool gets_other_handles);

 private:
  void Run();
  template <typename Visit>
  void ForEachOther(const FakeEndpoint& endpoint, const Visit& visit);

  std::mutex mutex_;
  std::condition_variable wake_;
  std::deque<std::function<void()>> tasks_;
  bool ends_ = false;
  std::uint64_t made_ = 0;
  std::vector<FakeParticipant*> members_;
  std::vector<std::shared_ptr<FakeEndpoint>> endpoints_;
  std::vector<std::shared_ptr<FakeEndpoint>> cut_off_;
  std::thread thread_;
};

class FakeWriter final : public WireWriter {
 public:
  FakeWriter(FakeNetwork& network, std::shared_ptr<FakeEndpoint> endpoint)
      : network_(network), endpoint_(std::move(endpoint)) {}
  ~FakeWriter() override {
    network_.Do([&] { network_.RemoveEndpoint(endpoint_); });
  }
  [[nodiscard]] const WireId& id() const noexcept override { return endpoint_->about.id; }
  [[nodiscard]] bool HasReader(std::uint64_t reader) const override {
    const std::lock_guard lock(endpoint_->mutex);
    return endpoint_->others.contains(reader);
  }
  Result<void> Write(const std::shared_ptr<const Octets>& octets, std::int64_t source_time) override {
    (void)WriteRelated(octets, source_time, {});
    return {};
  }
  Result<WireIdentity> WriteRelated(const std::shared_ptr<const Octets>& octets, std::int64_t source_time,
                                    const WireIdentity& related) override {
    const WireIdentity identity{id(), ++written_};
    network_.Post([this, endpoint = endpoint_, value = FakeEndpoint::Value{octets, source_time, identity, related}] {
      network_.Deliver(*endpoint, value);
    });
    return identity;
  }

 private:
  FakeNetwork& network_;
  const std::shared_ptr<FakeEndpoint> endpoint_;
  std::int64_t written_ = 0;
};

class FakeReader final : public WireReader {
 public:
  FakeReader(FakeNetwork& network, std::shared_ptr<FakeEndpoint> endpoint)
      : network_(network), endpoint_(std::move(endpoint)) {}
  ~FakeReader() override {
    network_.Do([&] { network_.RemoveEndpoint(endpoint_); });
  }
  [[nodiscard]] const WireId& id() const noexcept override { return endpoint_->about.id; }

 private:
  FakeNetwork& network_;
  const std::shared_ptr<FakeEndpoint> endpoint_;
};

class FakeParticipant final : public WireParticipant {
 public:
  FakeParticipant(FakeNetwork& network, WireMemberOptions options, WireDiscovery& discovery)
      : network_(network),
        about_{network.NewId(), options.name, options.user_data},
        domain_(options.domain),
        discovery_(discovery) {
    network_.Do([this] { network_.AddMember(*this); });
  }
  ~FakeParticipant() override {
    network_.Do([this] { network_.RemoveMember(*this); });
  }

  [[nodiscard]] const WireId& id() const noexcept override { return about_.id; }
  [[nodiscard]] const WireMember& about() const noexcept { return about_; }
  [[nodiscard]] std::uint32_t domain() const noexcept { return domain_; }
  [[nodiscard]] WireDiscovery& discovery() const noexcept { return discovery_; }

  Result<std::unique_ptr<WireWriter>> MakeWriter(const WireEndpointOptions& options, OnMatched on_matched) override {
    auto endpoint = Make(options, true, {}, std::move(on_matched));
    return std::unique_ptr<WireWriter>(new FakeWriter(network_, std::move(endpoint)));
  }
  Result<std::unique_ptr<WireReader>> MakeReader(const WireEndpointOptions& options, OnSample on_sample,
                                                 OnMatched on_matched) override {
    auto endpoint = Make(options, false, std::move(on_sample), std::move(on_matched));
    return std::unique_ptr<WireReader>(new FakeReader(network_, std::move(endpoint)));
  }

 private:
  std::shared_ptr<FakeEndpoint> Make(const WireEndpointOptions& options, bool is_writer, OnSample on_sample,
                                     OnMatched on_matched) {
    auto endpoint = std::make_shared<FakeEndpoint>();
    endpoint->about = {.id = network_.NewId(), .participant = about_.id, .is_writer = is_writer, .options = options};
    std::memcpy(&endpoint->about.handle, endpoint->about.id.data(), sizeof endpoint->about.handle);
    endpoint->participant = this;
    endpoint->on_sample = std::move(on_sample);
    endpoint->on_matched = std::move(on_matched);
    network_.Post([this, endpoint] { network_.AddEndpoint(endpoint); });
    return endpoint;
  }

  FakeNetwork& network_;
  const WireMember about_;
  const std::uint32_t domain_;
  WireDiscovery& discovery_;
};

void FakeNetwork::Run() {
  std::unique_lock lock(mutex_);
  for (;;) {
    wake_.wait(lock, [this] { return ends_ || !tasks_.empty(); });
    if (tasks_.empty()) return;
    const auto task = std::move(tasks_.front());
    tasks_.pop_front();
    lock.unlock();
    task();
    lock.lock();
  }
}

void Tell(const FakeParticipant& member, WireEndpoint endpoint) {
  endpoint.is_own = endpoint.participant == member.about().id;
  if (!CallBack([&] { member.discovery().OnEndpoint(endpoint); })) member.discovery().OnMissed();
}
void Tell(const FakeParticipant& member, const FakeParticipant& other) {
  if (!CallBack([&] { member.discovery().OnMember(other.about()); })) member.discovery().OnMissed();
}

void FakeNetwork::AddMember(FakeParticipant& member) {
  members_.push_back(&member);
  for (FakeParticipant* const each : members_) {
    if (each->domain() != member.domain()) continue;
    Tell(*each, member);
    if (each != &member) Tell(member, *each);
  }
  for (const auto& each : endpoints_) {
    if (each->participant->domain() == member.domain()) Tell(member, each->about);
  }
}

void FakeNetwork::RemoveMember(FakeParticipant& member) {
  std::erase(members_, &member);
  for (FakeParticipant* const each : members_) {
    if (each->domain() == member.domain()) each->discovery().OnMemberGone(member.id());
  }
}

template <typename Visit>
void FakeNetwork::ForEachOther(const FakeEndpoint& endpoint, const Visit& visit) {
  for (const auto& other : endpoints_) {
    const WireEndpointOptions& mine = endpoint.about.options;
    const WireEndpointOptions& its = other->about.options;
    if (other->participant == endpoint.participant || other->participant->domain() != endpoint.participant->domain() ||
        other->about.is_writer == endpoint.about.is_writer || mine.topic != its.topic || mine.type != its.type) {
      continue;
    }
    const bool is_writer = endpoint.about.is_writer;
    if (QosMisfit(is_writer ? mine.qos : its.qos, is_writer ? its.qos : mine.qos).empty()) visit(*other);
  }
}

void Note(FakeEndpoint& endpoint, const FakeEndpoint& other, bool is_there) {
  const std::lock_guard lock(endpoint.mutex);
  if (is_there) endpoint.others.insert(other.about.handle);
  if (!is_there) endpoint.others.erase(other.about.handle);
}

void Count(FakeEndpoint& endpoint, std::size_t change) {
  endpoint.matched += change;
  if (endpoint.on_matched) CallBack([&] { endpoint.on_matched(endpoint.matched); });
}

void FakeNetwork::AddEndpoint(const std::shared_ptr<FakeEndpoint>& endpoint) {
  endpoints_.push_back(endpoint);
  for (FakeParticipant* const each : members_) {
    if (each->domain() == endpoint->participant->domain()) Tell(*each, endpoint->about);
  }
  ForEachOther(*endpoint, [&](FakeEndpoint& other) {
    Note(other, *endpoint, true);
    Note(*endpoint, other, true);
    Count(other, 1);
    Count(*endpoint, 1);
    const FakeEndpoint& writer = endpoint->about.is_writer ? *endpoint : other;
    const FakeEndpoint& reader = endpoint->about.is_writer ? other : *endpoint;
    if (!reader.about.options.qos.is_latched) return;
    for (const auto& value : writer.kept) reader.Take(value, writer.about.handle);
  });
}

void FakeNetwork::RemoveEndpoint(const std::shared_ptr<FakeEndpoint>& endpoint) {
  if (std::erase(cut_off_, endpoint) > 0) return;
  std::erase(endpoints_, endpoint);
  for (FakeParticipant* const each : members_) {
    if (each->domain() == endpoint->participant->domain()) {
      each->discovery().OnEndpointGone(endpoint->about.id);
    }
  }
  ForEachOther(*endpoint, [&](FakeEndpoint& other) {
    Note(other, *endpoint, false);
    Note(*endpoint, other, false);
    Count(other, static_cast<std::size_t>(-1));
  });
}

void FakeNetwork::Deliver(FakeEndpoint& writer, const FakeEndpoint::Value& value) {
  if (writer.about.options.qos.is_latched) {
    writer.kept.push_back(value);
    if (writer.kept.size() > writer.about.options.qos.depth) writer.kept.pop_front();
  }
  if (std::ranges::any_of(cut_off_, [&](const auto& each) { return each.get() == &writer; })) return;
  ForEachOther(writer, [&](FakeEndpoint& reader) { reader.Take(value, writer.about.handle); });
}

void FakeNetwork::SetCutOff(const std::string& name, bool is_cut_off, bool gets_other_handles) {
  for (const auto& each : std::vector(is_cut_off ? endpoints_ : cut_off_)) {
    if (each->participant->about().name != name) continue;
    if (is_cut_off) {
      RemoveEndpoint(each);
      Count(*each, -each->matched);
      cut_off_.push_back(each);
    } else {
      std::erase(cut_off_, each);
      if (gets_other_handles) each->about.handle += std::uint64_t{1} << 32;
      AddEndpoint(each);
    }
  }
}

Result<std::unique_ptr<WireParticipant>> FakeNetwork::Join(const WireMemberOptions& options, WireDiscovery& discovery) {
  return std::unique_ptr<WireParticipant>(new FakeParticipant(*this, options, discovery));
}

}  // namespace

std::shared_ptr<WireEngine> MakeFakeWire() { return std::make_shared<FakeNetwork>(); }

void SetCutOff(WireEngine& fake, const std::string& name, bool is_cut_off, bool gets_other_handles) {
  auto& network = static_cast<FakeNetwork&>(fake);
  network.Do([&] { network.SetCutOff(name, is_cut_off, gets_other_handles); });
}

void WaitUntilQuiet(WireEngine& fake) {
  static_cast<FakeNetwork&>(fake).Do([] {});
}

}  // namespace runnel
