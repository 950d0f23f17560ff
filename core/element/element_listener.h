#pragma once

namespace runnel {

class FrameworkElement;

/// Told of every change of the structure, in the order of the changes. Schedulers, network links
/// and viewers live on it.
///
/// Threads:  called under the structure lock, by the thread that makes the change. A listener may
///           change the structure itself, but not delete, and must not wait for another thread that
///           does.
/// Errors:   must not throw.
class ElementListener {
 public:
  virtual ~ElementListener() = default;

  /// The element and all below it have become ready: they are complete and configured.
  virtual void OnReady(FrameworkElement& /*element*/) {}
  /// The element and all below it are about to be deleted; they are still whole, and marked
  /// deleted. If it throws, for lack of memory, it is called again.
  virtual void OnDeleted(FrameworkElement& /*element*/) {}
  /// Ports: data now flows, or no longer flows, from one to the other.
  virtual void OnConnected(FrameworkElement& /*from*/, FrameworkElement& /*to*/) {}
  virtual void OnDisconnected(FrameworkElement& /*from*/, FrameworkElement& /*to*/) {}

  /// Whoever has made the changes told of since the last call has made all that belong together
  /// (ChangeScope), and is about to let go of the structure lock. Not called for a change that is
  /// made in no scope: that one stands by itself.
  virtual void OnChangesEnd() {}
};

}  // namespace runnel
