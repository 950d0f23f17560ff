// Ports of services and clients whose types are known at run time only.

#include "core/channel/channel.h"
#include "core/channel/distribution.h"
#include "core/port/bound_input.h"
#include "core/port/output_base.h"
#include "core/port/typed_ports.h"
#include "plugins/services/services_at_run_time.h"

namespace runnel {

namespace {

// Like any ServiceLink; the port says of which type it is.
struct AnyLink {
  ServiceEndpoint* endpoint = nullptr;
};

class AnyLinkOutput final : public OutputBase {
 public:
  AnyLinkOutput(const TypeInfo& link, FrameworkElement& group, std::string name, OutputOptions options)
      : OutputBase(group, std::move(name), link, std::move(options),
                   std::make_unique<Channel<AnyLink>>(PoolOptions{}, BufferPool<AnyLink>::Factory{})) {}
};

class AnyLinkInput final : public BoundInput {
 public:
  AnyLinkInput(const TypeInfo& link, FrameworkElement& group, std::string name, InputOptions options)
      : BoundInput(group, std::move(name), link, std::move(options)) {}
  ~AnyLinkInput() override { DisconnectForEver(); }

  // A client has one service.
  bool VisitLatest(const Visitor& visit) const override {
    const EpochGuard guard;
    const Binding& bound = *binding();
    return bound.channel != nullptr && bound.channel->VisitLatest(visit);
  }

 private:
  [[nodiscard]] bool HasNew() const override { return false; }
  [[nodiscard]] std::unique_ptr<InputQueueBase> MakeQueue(std::size_t capacity, OnFull on_full,
                                                          Writers writers) const override {
    return internal::DistributionOf<AnyLink>::MakeQueue(capacity, on_full, writers);
  }
};

}  // namespace

std::unique_ptr<Port> MakeLinkOutput(const TypeInfo& link, FrameworkElement& group, std::string name,
                                     OutputOptions options) {
  if (const TypedPorts* const ports = FindTypedPorts(link)) return ports->MakeOutput(group, std::move(name), options);
  return std::make_unique<AnyLinkOutput>(link, group, std::move(name), std::move(options));
}

std::unique_ptr<Port> MakeLinkInput(const TypeInfo& link, FrameworkElement& group, std::string name,
                                    InputOptions options) {
  if (const TypedPorts* const ports = FindTypedPorts(link)) return ports->MakeInput(group, std::move(name), options);
  return std::make_unique<AnyLinkInput>(link, group, std::move(name), std::move(options));
}

}  // namespace runnel
