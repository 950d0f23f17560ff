#include "plugins/wire_shared_memory/shared_memory_wire.h"

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <fstream>
#include <map>
#include <mutex>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include "plugins/wire_shared_memory/segment_server.h"

namespace runnel {

namespace {

constexpr std::string_view kKey = "shared_memory=";
constexpr const char* kLayout = "/2";  // of what is shared: others are sent octets

/// What a member says of itself, so that those who share this machine's memory with it know each other: same machine
/// since it was started, same network, same user. "shared_memory=0123456789abcdef;".
std::string MemoryOfThisProcess() {
  std::string started;
  std::getline(std::ifstream("/proc/sys/kernel/random/boot_id") >> std::ws, started);
  struct stat network {};
  // Without either, alone.
  if (started.empty() || stat("/proc/self/ns/net", &network) != 0) started = std::to_string(getpid());
  const std::string text = started + '/' + std::to_string(network.st_ino) + '/' + std::to_string(geteuid()) + kLayout;
  std::uint64_t hash = 0xcbf29ce484222325;  // FNV-1a: others need not know the parts
  for (const char each : text) hash = (hash ^ static_cast<unsigned char>(each)) * 0x100000001b3;
  return fmt::format("{}{:016x};", kKey, hash);
}

/// What a member says besides.
std::string WithoutMemory(std::string user_data) {
  const std::size_t begin = user_data.find(kKey);
  if (begin != std::string::npos) user_data.erase(begin, user_data.find(';', begin) - begin + 1);
  return user_data;
}

/// Who reads which topic, and whether it shares this process's memory.
///
/// Threads: any.
class Neighbours {
 public:
  explicit Neighbours(std::string memory) : memory_(std::move(memory)) {}

  void Add(const WireMember& member) {
    const std::lock_guard lock(mutex_);
    if (member.user_data.find(memory_) != std::string::npos) {
      sharing_.insert(member.id);
    } else {
      sharing_.erase(member.id);
    }
  }
  void RemoveMember(const WireId& id) {
    const std::lock_guard lock(mutex_);
    sharing_.erase(id);
  }
  void Add(const WireEndpoint& endpoint) {
    const std::lock_guard lock(mutex_);
    if (!endpoint.is_own) endpoints_[endpoint.id] = endpoint;
  }
  void RemoveEndpoint(const WireId& id) {
    const std::lock_guard lock(mutex_);
    endpoints_.erase(id);
  }

  /// Whether there are `matched` readers of the topic at least, and all that there are share the memory.
  [[nodiscard]] bool AllShare(const std::string& topic, std::size_t matched) const {
    const std::lock_guard lock(mutex_);
    std::size_t count = 0;
    for (const auto& [id, each] : endpoints_) {
      if (each.is_writer || each.options.topic != topic) continue;
      if (!sharing_.contains(each.participant)) return false;
      ++count;
    }
    return count > 0 && count >= matched;
  }
  /// Whether it is known of a writer that it is there.
  [[nodiscard]] bool IsThere(std::uint64_t writer) const {
    const std::lock_guard lock(mutex_);
    return std::ranges::any_of(endpoints_,
                               [&](const auto& each) { return each.second.is_writer && each.second.handle == writer; });
  }

 private:
  const std::string memory_;
  mutable std::mutex mutex_;
  std::set<WireId> sharing_;  // members
  std::map<WireId, WireEndpoint> endpoints_;
};

/// What the endpoints of a participant share.
struct Common {
  Neighbours neighbours{MemoryOfThisProcess()};

  /// nullptr if the system does not permit it. The first one is made when it is needed.
  SegmentServer* Server() {
    const std::lock_guard lock(mutex);
    if (server == nullptr && !has_failed) {
      auto started = SegmentServer::Start();
      has_failed = !started.has_value();
      if (started) server = std::move(*started);
    }
    return server.get();
  }

  std::mutex mutex;
  std::unique_ptr<SegmentServer> server;
  bool has_failed = false;
};

// What is latched is kept by the engine for who comes late; each of many values is more than slots are there for.
bool MayShare(const WireQos& qos) { return !qos.is_latched && (qos.depth == 1 || !qos.is_reliable); }

class SharingWriter final : public WireWriter {
 public:
  SharingWriter(Common& common, const WireEndpointOptions& options)
      : common_(common), topic_(options.topic), may_share_(MayShare(options.qos)) {}
  ~SharingWriter() override {
    inner_.reset();
    Release();
  }
  void Begin(std::unique_ptr<WireWriter> inner) { inner_ = std::move(inner); }
  void OnMatched(std::size_t count) {
    matched_.store(count, std::memory_order_relaxed);
    if (count == 0) {
      const std::lock_guard lock(mutex_);
      Release();
    }
  }

  [[nodiscard]] const WireId& id() const noexcept override { return inner_->id(); }
  [[nodiscard]] bool HasReader(std::uint64_t reader) const override { return inner_->HasReader(reader); }
  Result<void> Write(const std::shared_ptr<const Octets>& octets, std::int64_t source_time) override {
    if (may_share_ && octets->size() >= kLargeValue &&
        common_.neighbours.AllShare(topic_, matched_.load(std::memory_order_relaxed))) {
      if (const auto place = Put(*octets)) return inner_->Write(place->ToOctets(), source_time);
    }
    return inner_->Write(octets, source_time);
  }
  Result<WireIdentity> WriteRelated(const std::shared_ptr<const Octets>& octets, std::int64_t source_time,
                                    const WireIdentity& related) override {
    return inner_->WriteRelated(octets, source_time, related);
  }

 private:
  // Nothing: there is no shared memory, or others hold all of it. Values may go the long way as well.
  std::optional<SegmentPlace> Put(const Octets& octets) {
    const std::lock_guard lock(mutex_);
    SegmentServer* const server = common_.Server();
    if (server == nullptr) return {};
    if (segment_ == nullptr || octets.size() > segment_->room()) {
      Release();
      auto made = WrittenSegment::Make(octets.size() + octets.size() / 4);
      if (!made) return {};
      segment_ = std::move(*made);
      server->Offer(*segment_);
    }
    auto place = segment_->Put(octets);
    if (place) place->server = server->id();
    return place;
  }
  void Release() {
    if (segment_ == nullptr) return;
    common_.Server()->Withdraw(*segment_);
    segment_.reset();
  }

  Common& common_;
  const std::string topic_;
  const bool may_share_;
  std::atomic<std::size_t> matched_{0};
  std::mutex mutex_;
  std::unique_ptr<WrittenSegment> segment_;  // guarded by mutex_
  std::unique_ptr<WireWriter> inner_;
};

/// So many values of a writer one reader may hold. More are copied, so that others find memory, too.
constexpr std::uint32_t kMostHeld = 16;

/// What readers do with a sample: one at a time for each.
class Finder {
 public:
  Finder(Common& common, OnSample on_sample) : common_(common), on_sample_(std::move(on_sample)) {}

  void operator()(const WireSample& sample) {
    const auto place = SegmentPlace::In(sample.octets);
    if (!place) return on_sample_(sample);
    WireSample found = sample;
    found.octets = {};
    const auto segment = Find(*place, sample.writer);
    if (!segment) {
      found.flaw = segment.error().message;
      return on_sample_(found);
    }
    const auto held = (*segment)->Hold(*place);
    if (held == nullptr) {
      found.flaw = "newer values had taken the place of one before it was read";
      return on_sample_(found);
    }
    found.octets = std::span(held.get(), place->size);
    if ((*segment)->held() <= kMostHeld) found.holder = held;
    on_sample_(found);
  }

 private:
  struct Known {
    SegmentId id;
    std::uint64_t writer;
    std::shared_ptr<ReadSegment> segment;
  };
  static constexpr std::size_t kMost = 8;  // writers with large values, of one topic

  Result<std::shared_ptr<ReadSegment>> Find(const SegmentPlace& place, std::uint64_t writer) {
    for (const Known& each : known_) {
      if (each.id == place.segment) return each.segment;
    }
    auto fetched = FetchSegment(place);
    if (!fetched) return fetched.error();
    // A writer has one at a time.
    std::erase_if(known_,
                  [&](const Known& each) { return each.writer == writer || !common_.neighbours.IsThere(each.writer); });
    if (known_.size() >= kMost) known_.erase(known_.begin());
    known_.push_back({place.segment, writer, std::move(*fetched)});
    return known_.back().segment;
  }

  Common& common_;
  const OnSample on_sample_;
  std::vector<Known> known_;
};

class SharingParticipant final : public WireParticipant, private WireDiscovery {
 public:
  explicit SharingParticipant(WireDiscovery& discovery) : discovery_(discovery) {}
  ~SharingParticipant() override { inner_.reset(); }
  Result<void> Begin(WireEngine& engine, WireMemberOptions options) {
    options.user_data += MemoryOfThisProcess();
    auto joined = engine.Join(options, *this);
    if (!joined) return joined.error();
    inner_ = std::move(*joined);
    return {};
  }

  [[nodiscard]] const WireId& id() const noexcept override { return inner_->id(); }
  Result<std::unique_ptr<WireWriter>> MakeWriter(const WireEndpointOptions& options, OnMatched on_matched) override {
    auto writer = std::make_unique<SharingWriter>(common_, options);
    auto inner =
        inner_->MakeWriter(options, [raw = writer.get(), on_matched = std::move(on_matched)](std::size_t count) {
          raw->OnMatched(count);
          if (on_matched) on_matched(count);
        });
    if (!inner) return inner.error();
    writer->Begin(std::move(*inner));
    return std::unique_ptr<WireWriter>(std::move(writer));
  }
  Result<std::unique_ptr<WireReader>> MakeReader(const WireEndpointOptions& options, OnSample on_sample,
                                                 OnMatched on_matched) override {
    auto finder = std::make_shared<Finder>(common_, std::move(on_sample));
    return inner_->MakeReader(
        options, [finder](const WireSample& sample) { (*finder)(sample); }, std::move(on_matched));
  }

 private:
  void OnMember(const WireMember& member) override {
    common_.neighbours.Add(member);
    WireMember others = member;
    others.user_data = WithoutMemory(member.user_data);
    discovery_.OnMember(others);
  }
  void OnMemberGone(const WireId& id) override {
    common_.neighbours.RemoveMember(id);
    discovery_.OnMemberGone(id);
  }
  void OnEndpoint(const WireEndpoint& endpoint) override {
    common_.neighbours.Add(endpoint);
    discovery_.OnEndpoint(endpoint);
  }
  void OnEndpointGone(const WireId& id) override {
    common_.neighbours.RemoveEndpoint(id);
    discovery_.OnEndpointGone(id);
  }
  void OnMissed() noexcept override { discovery_.OnMissed(); }

  WireDiscovery& discovery_;
  Common common_;
  std::unique_ptr<WireParticipant> inner_;
};

class SharedMemoryWire final : public WireEngine {
 public:
  explicit SharedMemoryWire(std::shared_ptr<WireEngine> engine) : engine_(std::move(engine)) {}

  [[nodiscard]] bool has_identities() const noexcept override { return engine_->has_identities(); }
  Result<std::unique_ptr<WireParticipant>> Join(const WireMemberOptions& options, WireDiscovery& discovery) override {
    if (options.security) return engine_->Join(options, discovery);  // whoever has no keys is to see nothing
    auto made = std::make_unique<SharingParticipant>(discovery);
    if (const auto begun = made->Begin(*engine_, options); !begun) return begun.error();
    return std::unique_ptr<WireParticipant>(std::move(made));
  }

 private:
  const std::shared_ptr<WireEngine> engine_;
};

}  // namespace

std::shared_ptr<WireEngine> MakeSharedMemoryWire(std::shared_ptr<WireEngine> engine) {
  return std::make_shared<SharedMemoryWire>(std::move(engine));
}

}  // namespace runnel
