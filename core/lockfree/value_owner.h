#pragma once

namespace runnel {

/// Whom published values belong to that lie in no buffer of a pool: in the memory of a driver, of a
/// camera, shared with another process.
///
/// Ownership:   shared: whoever has published a value keeps its owner, with the memory, until the value has been
///              taken back. For an owner that lives longer in any case: std::shared_ptr<…>({}, &owner), which
///              counts nothing.
template <typename T>
class ValueOwner {
 public:
  /// Nobody holds `value` any more, and nobody will. Called once for each time it was published, by who
  /// looks for free buffers: the publisher, in its own thread; or, once the pool is closed, whoever has
  /// the closed ones looked at (HazardDomain::Reclaim()). Never by a reader. Inside a publisher's cycle,
  /// so it does not block; it neither loans from nor publishes into what the value was published by.
  virtual void TakeBack(const T& value) noexcept = 0;

  virtual ~ValueOwner() = default;
};

}  // namespace runnel
