#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/element/annotation.h"
#include "core/element/runtime.h"
#include "core/paths/path_search.h"
#include "core/port/port.h"

namespace runnel {

/// A connection that is to be whenever both its ends are there.
struct LateConnection {
  std::string from;  ///< absolute paths of ports that may be there or not; "//…": of another application
  std::string to;
  ConnectOptions options;
  /// Nothing if it is connected; else what it waits for, or what stands against it.
  std::optional<std::string> waits_for;

  /// Whether it is one as any but that another application has its output, which is waited for without anybody having said so:
  /// once made it is noted here no more, and it goes with its input.
  [[nodiscard]] bool is_of_its_input() const noexcept;
  /// The path of the output with the part of its values that is meant: "/world/pose.x".
  [[nodiscard]] std::string SourceText() const;
};

/// Connections whose ends may come later and go again: a driver that is plugged in, a module that is swapped
/// for nothing for a while. It is made when the second end appears, again after one went, and ends only when
/// somebody disconnects it.
///
/// One for a runtime, made when first asked for: who has no such connections pays nothing. From then on it
/// notes what is connected with ConnectOptions::when_present, too.
///
/// Threads:  under the structure lock.
class LateConnections final : public Annotation, private ElementListener {
 public:
  [[nodiscard]] static LateConnections& Of(Runtime& runtime);
  /// nullptr if nobody has asked for it.
  [[nodiscard]] static LateConnections* FindIn(Runtime& runtime);

  explicit LateConnections(Runtime& runtime);

  /// Whether it is to be fed by one of these.
  [[nodiscard]] static bool Awaits(const Port& input);

  /// From now on, and at once if both ends are there. Those of ports of other applications wait without being told to, so
  /// their options stay as they are. Paths begin at the root; the name of the only application
  /// may be left out, and groups of ports, too. Errors: they are, and cannot be connected, which has
  /// changed nothing then; it is there already.
  Result<void> Add(const std::string& from, const std::string& to, ConnectOptions options);
  /// As Add(), but is connected when the changes end, if it can be: what has been noted before may have ends that are
  /// there and do not fit. Within a ChangeScope.
  Result<void> Note(const std::string& from, const std::string& to, ConnectOptions options);
  /// No more, and what is connected is disconnected. False: there is no such connection.
  bool Remove(std::string_view from, std::string_view to);
  /// No more, if there is one; what is connected stays so.
  void Forget(std::string_view from, std::string_view to);

  /// Something may have come, or may be known, of which the tree does not tell.
  void LookAgain();

  /// In the order in which they were added.
  [[nodiscard]] const std::vector<LateConnection>& all() const noexcept { return all_; }
  [[nodiscard]] const LateConnection* Find(std::string_view from, std::string_view to) const;

 private:
  /// Of a connection that was cut: who its ends were.
  struct Cut {
    std::string from;
    std::string to;
    std::uint64_t from_id;
    std::uint64_t to_id;
  };

  /// What is there of the two.
  struct Ends;

  void OnReady(FrameworkElement& element) override;
  void OnDeleted(FrameworkElement& element) override;
  void OnConnected(FrameworkElement& from, FrameworkElement& to) override;
  void OnDisconnected(FrameworkElement& from, FrameworkElement& to) override;
  void OnChangesEnd() override;

  [[nodiscard]] Ends FindEnds(const std::string& from, const std::string& to) const;
  [[nodiscard]] LateConnection* FindOwn(std::string_view from, std::string_view to);
  void Try(const std::string& from, const std::string& to);

  Runtime& runtime_;
  std::vector<LateConnection> all_;
  std::vector<Cut> cuts_;
  bool must_look_ = false;
};

/// The whole path of what `search` finds and can be such an end; else of as much as it finds, without what the end is not.
/// Under the structure lock, as all below.
[[nodiscard]] std::string EndPath(const PathSearch& search, std::string_view path, PathKind kind);
/// One of `all`, by paths as `search` finds their ends: groups of ports may be left out. nullptr: there is none.
[[nodiscard]] const LateConnection* FindLate(const std::vector<LateConnection>& all, const PathSearch& search,
                                             std::string_view from, std::string_view to);

/// Those of `all` that wait and go with `element`, since their inputs are below it or it is one.
[[nodiscard]] std::vector<LateConnection> AwaitedWith(const std::vector<LateConnection>& all,
                                                      const FrameworkElement& element);

/// Those that wait and have the port as an end; all that wait and have an end below `element`.
[[nodiscard]] std::vector<const LateConnection*> AwaitedBy(const Port& port);
[[nodiscard]] std::vector<const LateConnection*> AwaitedBelow(const FrameworkElement& element);

}  // namespace runnel
