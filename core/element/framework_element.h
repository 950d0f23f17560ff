#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <stdexcept>
#include <string>
#include <string_view>
#include <typeindex>
#include <vector>

#include "core/base/result.h"
#include "core/element/annotation.h"

namespace runnel {

class FrameworkElement;
class Runtime;

/// Where a new element goes: below `parent`, under `name`. Elements take it as the only argument
/// that all of them share, so that `using Module::Module;` is all the constructor a module needs.
struct Placement {
  FrameworkElement& parent;
  std::string name;
  /// False: made beside the tree, where nobody finds it, until Runtime::List() puts it in.
  bool is_listed = true;
};

/// What an element is to a person who looks at the tree.
enum class ElementKind { kRuntime, kGroup, kModule, kPortGroup, kPort, kParameter, kThread, kOther };

/// The three stations of an element's life. Only a ready module is executed.
enum class LifeCycle {
  kConstructed,  ///< exists, can be configured and connected
  kReady,        ///< configured, Prepare() has succeeded
  kDeleted,      ///< taken out; its memory lives on until no thread can see it any more
};

/// The node of which everything in an application is made: groups, modules, ports and parameters
/// form one tree, in which a path such as "/robot/guard/input/scan" names each (FINROC,
/// section 4.2).
///
/// Ownership:  a parent owns the children that it was given by Runtime::Create(); an element that
///             is a member of a C++ object (a port of a module) belongs to that object and is only
///             listed.
/// Threads:    the tree is read and changed under Runtime::structure_mutex(). Functions marked
///             "locks" take it themselves. name(), path() and runtime() never change and need none.
/// Errors:     a constructor throws ElementError for a bad or duplicate name.
class FrameworkElement {
 public:
  explicit FrameworkElement(const Placement& placement, ElementKind kind = ElementKind::kOther);
  virtual ~FrameworkElement();
  FrameworkElement(const FrameworkElement&) = delete;
  FrameworkElement& operator=(const FrameworkElement&) = delete;

  [[nodiscard]] const std::string& name() const noexcept { return name_; }
  [[nodiscard]] const std::string& path() const noexcept { return path_; }
  [[nodiscard]] ElementKind kind() const noexcept { return kind_; }
  [[nodiscard]] LifeCycle life_cycle() const noexcept { return life_cycle_; }
  /// nullptr for the runtime, the root.
  [[nodiscard]] FrameworkElement* parent() const noexcept { return parent_; }
  [[nodiscard]] Runtime& runtime() const noexcept { return *runtime_; }
  /// In the order of their creation.
  [[nodiscard]] const std::vector<FrameworkElement*>& children() const noexcept { return children_; }
  /// The number of elements that the runtime had made before this one: an order that does not
  /// depend on addresses.
  [[nodiscard]] std::uint64_t id() const noexcept { return id_; }

  [[nodiscard]] FrameworkElement* FindChild(std::string_view child_name) const;
  /// Follows `path` from here, or from the root if it begins with '/'. ".." is the parent. The
  /// error names the part that is not there and what comes nearest to it.
  [[nodiscard]] Result<FrameworkElement*> Find(std::string_view path) const;
  [[nodiscard]] bool IsAtOrBelow(const FrameworkElement& ancestor) const noexcept;
  /// Calls `visit` for this element and all below it, parents before children.
  void Visit(const std::function<void(FrameworkElement&)>& visit);
  /// The same for those of them that are a T: ports, threads …
  template <typename T>
  void VisitAll(const std::function<void(T&)>& visit) {
    Visit([&](FrameworkElement& each) {
      if (auto* const found = dynamic_cast<T*>(&each)) visit(*found);
    });
  }

  /// Whether Construct() has made something, so that what it went by can no longer be set.
  [[nodiscard]] bool has_constructed() const noexcept { return has_constructed_; }

  /// Keeps one annotation of each type; a later one takes the place of the earlier.
  template <typename T>
  T& Annotate(std::unique_ptr<T> annotation) {
    T& reference = *annotation;
    annotations_[typeid(T)] = std::move(annotation);
    return reference;
  }
  /// Takes on what the annotations of `from`, and of what is below it under the same names, leave to an
  /// element that replaces it, or to one like it at another place. Under the structure lock.
  enum class Inherit { kAsReplacement, kAsCopy };
  void InheritAnnotations(const FrameworkElement& from, Inherit how = Inherit::kAsReplacement);
  /// nullptr if there is none.
  template <typename T>
  [[nodiscard]] T* FindAnnotation() const {
    const auto found = annotations_.find(typeid(T));
    return found == annotations_.end() ? nullptr : static_cast<T*>(found->second.get());
  }
  /// Made of `arguments` if there is none.
  template <typename T, typename... Arguments>
  T& FindOrAnnotate(Arguments&&... arguments) {
    T* const found = FindAnnotation<T>();
    return found != nullptr ? *found : Annotate(std::make_unique<T>(std::forward<Arguments>(arguments)...));
  }

 protected:
  /// Called once, when the parameters are set and before anybody looks for ports: make here the ports, and in
  /// a composite the modules and connections, whose number, names or types follow from static parameters.
  /// As a constructor it has no effect on the world: tools call it with the values of default, just to list what
  /// there is. An error or an exception keeps the element from being used.
  virtual Result<void> Construct() { return {}; }
  /// Called when the element becomes ready, and again after it could not: parameters are set, ports
  /// are there. Open files and reserve memory here. An error or an exception keeps the whole new
  /// structure from becoming ready.
  virtual Result<void> Prepare() { return {}; }
  /// Called under the structure lock before the element is deleted; undo here what ties it to
  /// others.
  virtual void Detach() noexcept {}

 private:
  friend class Runtime;
  friend class UnlistedElement;
  struct RootTag {};
  FrameworkElement(RootTag, Runtime& runtime);

  // Into the parent's list, before `place` (nullptr: at the end); throws ElementError.
  void JoinParent(const FrameworkElement* place);
  [[nodiscard]] bool IsInTree() const noexcept;
  // Out of the parent's list: from then on nobody finds the element from the root.
  void LeaveParent() noexcept;
  // The children before this element, so that none sees its parent half destroyed.
  void DestroyOwned() noexcept;

  std::string name_;
  std::string path_;  // kept: an element that has been taken out may outlive its parents
  ElementKind kind_;
  LifeCycle life_cycle_ = LifeCycle::kConstructed;
  FrameworkElement* parent_ = nullptr;
  Runtime* runtime_ = nullptr;
  std::uint64_t id_ = 0;
  bool is_listed_ = false;  // among the children of its parent
  bool is_whole_ = false;   // Construct() has been called
  bool has_constructed_ = false;
  std::vector<FrameworkElement*> children_;
  std::map<std::string, FrameworkElement*, std::less<>> children_by_name_;
  std::vector<std::unique_ptr<FrameworkElement>> owned_;
  std::map<std::type_index, std::unique_ptr<Annotation>> annotations_;
};

/// Thrown by the constructor of an element that cannot be placed where it was to go.
class ElementError : public std::runtime_error {
 public:
  explicit ElementError(Error error) : std::runtime_error(error.ToString()), error_(std::move(error)) {}
  [[nodiscard]] const Error& error() const noexcept { return error_; }

 private:
  Error error_;
};

}  // namespace runnel
