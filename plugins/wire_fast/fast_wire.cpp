#include "plugins/wire_fast/fast_wire.h"

#include <utility>

#include <fastdds/dds/domain/DomainParticipant.hpp>
#include <fastdds/dds/domain/DomainParticipantFactory.hpp>
#include <fastrtps/attributes/LibrarySettingsAttributes.h>
#include <fastrtps/xmlparser/XMLProfileManager.h>

#include "plugins/wire_fast/fast_discovery.h"
#include "plugins/wire_fast/fast_endpoints.h"
#include "plugins/wire_fast/fast_settings.h"

namespace runnel {

namespace {

namespace dds = eprosima::fastdds::dds;

class FastParticipant final : public WireParticipant {
 public:
  FastParticipant(std::shared_ptr<dds::DomainParticipantFactory> factory, WireDiscovery& discovery)
      : factory_(std::move(factory)), discovery_(discovery) {}
  ~FastParticipant() override {
    member_.reset();
    if (participant_ == nullptr) return;
    (void)participant_->set_listener(nullptr);
    (void)factory_->delete_participant(participant_);
  }

  Result<void> Begin(const WireMemberOptions& options) {
    has_keys_ = options.security.has_value();
    if (has_keys_) HearFastSecurity();
    const auto kept = std::make_shared<Result<void>>();
    const auto qos = MemberQos(options, kept);
    if (!qos) return qos.error();
    participant_ = factory_->create_participant(options.domain, *qos, &discovery_, dds::StatusMask::none());
    if (participant_ == nullptr) {
      Error error = FastError("the network cannot be joined");
      if (options.security) error.hint = KeyFilesHint(*options.security);
      return error;
    }
    if (!*kept) return *kept;
    member_ = std::make_unique<FastMember>(*participant_, discovery_);
    discovery_.TellMember({.id = id(), .name = options.name, .user_data = options.user_data});
    return {};
  }

  [[nodiscard]] const WireId& id() const noexcept override { return member_->id(); }

  Result<std::unique_ptr<WireWriter>> MakeWriter(const WireEndpointOptions& options, OnMatched on_matched) override {
    auto made = MakeFastWriter(*member_, options, std::move(on_matched));
    if (!made) return WithPermissionHint(made.error(), has_keys_, options, true);
    return made;
  }
  Result<std::unique_ptr<WireReader>> MakeReader(const WireEndpointOptions& options, OnSample on_sample,
                                                 OnMatched on_matched) override {
    auto made = MakeFastReader(*member_, options, std::move(on_sample), std::move(on_matched));
    if (!made) return WithPermissionHint(made.error(), has_keys_, options, false);
    return made;
  }

 private:
  const std::shared_ptr<dds::DomainParticipantFactory> factory_;
  FastDiscovery discovery_;
  dds::DomainParticipant* participant_ = nullptr;
  std::unique_ptr<FastMember> member_;
  bool has_keys_ = false;
};

class FastWire final : public WireEngine {
 public:
  FastWire() {
    HearFastLog();
    factory_ = dds::DomainParticipantFactory::get_shared_instance();
    (void)factory_->load_profiles();
    // Those of one process are as far from each other as those of two: callbacks come from the engine's threads.
    eprosima::fastrtps::LibrarySettingsAttributes settings;
    settings.intraprocess_delivery = eprosima::fastrtps::INTRAPROCESS_OFF;
    eprosima::fastrtps::xmlparser::XMLProfileManager::library_settings(settings);
  }
  [[nodiscard]] bool has_identities() const noexcept override { return true; }
  Result<std::unique_ptr<WireParticipant>> Join(const WireMemberOptions& options, WireDiscovery& discovery) override {
    auto participant = std::make_unique<FastParticipant>(factory_, discovery);
    if (const auto begun = participant->Begin(options); !begun) return begun.error();
    return std::unique_ptr<WireParticipant>(std::move(participant));
  }

 private:
  std::shared_ptr<dds::DomainParticipantFactory> factory_;
};

}  // namespace

std::shared_ptr<WireEngine> MakeFastWire() { return std::make_shared<FastWire>(); }

}  // namespace runnel
