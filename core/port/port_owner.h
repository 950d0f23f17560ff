#pragma once

namespace runnel {

class FrameworkElement;

/// What has a group for its inputs and one for its outputs, made when first asked for. Lets a
/// module hand itself to its ports: `Input<RangeScan> scan{this, "scan"};`
class PortOwner {
 public:
  [[nodiscard]] virtual FrameworkElement& InputGroup() = 0;
  [[nodiscard]] virtual FrameworkElement& OutputGroup() = 0;

 protected:
  ~PortOwner() = default;
};

}  // namespace runnel
