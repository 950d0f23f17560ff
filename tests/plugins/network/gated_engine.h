#pragma once

#include <atomic>
#include <memory>
#include <utility>

#include "plugins/wire/wire.h"

namespace runnel::test {

/// Lets no value through while it is closed.
class Gate {
 public:
  void Close() { is_closed_ = true; }
  void Open() {
    is_closed_ = false;
    is_closed_.notify_all();
  }
  void Pass() {
    ++arrived_;
    is_closed_.wait(true);
  }
  [[nodiscard]] int arrived() const { return arrived_; }

 private:
  std::atomic<bool> is_closed_{false};
  std::atomic<int> arrived_{0};
};

/// An engine whose writers of /place have to pass the gate.
class GatedEngine final : public WireEngine {
 public:
  GatedEngine(std::shared_ptr<WireEngine> engine, Gate& gate) : engine_(std::move(engine)), gate_(gate) {}
  Result<std::unique_ptr<WireParticipant>> Join(const WireMemberOptions& options, WireDiscovery& discovery) override {
    auto joined = engine_->Join(options, discovery);
    if (!joined) return joined.error();
    return std::unique_ptr<WireParticipant>(std::make_unique<GatedParticipant>(std::move(*joined), gate_));
  }

 private:
  class GatedWriter final : public WireWriter {
   public:
    GatedWriter(std::unique_ptr<WireWriter> inner, Gate& gate) : inner_(std::move(inner)), gate_(gate) {}
    [[nodiscard]] const WireId& id() const noexcept override { return inner_->id(); }
    [[nodiscard]] bool HasReader(std::uint64_t reader) const override { return inner_->HasReader(reader); }
    Result<void> Write(const std::shared_ptr<const Octets>& octets, std::int64_t source_time) override {
      gate_.Pass();
      return inner_->Write(octets, source_time);
    }

   private:
    const std::unique_ptr<WireWriter> inner_;
    Gate& gate_;
  };
  class GatedParticipant final : public WireParticipant {
   public:
    GatedParticipant(std::unique_ptr<WireParticipant> inner, Gate& gate) : inner_(std::move(inner)), gate_(gate) {}
    [[nodiscard]] const WireId& id() const noexcept override { return inner_->id(); }
    Result<std::unique_ptr<WireWriter>> MakeWriter(const WireEndpointOptions& options, OnMatched on_matched) override {
      auto made = inner_->MakeWriter(options, std::move(on_matched));
      if (!made || options.topic != "rt/place") return made;
      return std::unique_ptr<WireWriter>(std::make_unique<GatedWriter>(std::move(*made), gate_));
    }
    Result<std::unique_ptr<WireReader>> MakeReader(const WireEndpointOptions& options, OnSample on_sample,
                                                   OnMatched on_matched) override {
      return inner_->MakeReader(options, std::move(on_sample), std::move(on_matched));
    }

   private:
    const std::unique_ptr<WireParticipant> inner_;
    Gate& gate_;
  };

  const std::shared_ptr<WireEngine> engine_;
  Gate& gate_;
};

}  // namespace runnel::test
