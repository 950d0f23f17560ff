#pragma once

#include <algorithm>
#include <cstddef>
#include <initializer_list>
#include <iterator>
#include <memory>
#include <stdexcept>
#include <type_traits>
#include <utility>
#include <vector>

namespace runnel {

/// A list of numbers as std::vector is one, whose memory may also be somebody else's: of a driver, of another process. It is
/// used as a std::vector; what lies elsewhere is copied by the first call that could change it (copy on write).
///
///     image.data.resize(n);                        // memory of its own, used again as that of a vector
///     image.data.ReferTo(first, count, holder);    // looks at somebody else's, kept by `holder`
///     const SharedVector<float> same = cloud.data; // refers to it, too, and keeps the holder as well
///
/// Ownership:   of its elements; or of a share in `holder`, which goes with the last list that refers to them.
/// Threads:     as std::vector: any number look at it while nobody changes it.
/// Allocation:  as std::vector, and all elements when what lies elsewhere is to be changed. Looking costs what it costs there.
template <typename T>
class SharedVector {
  static_assert(std::is_arithmetic_v<T> && !std::is_same_v<T, bool>, "a SharedVector has plain numbers");

 public:
  using value_type = T;
  using size_type = std::size_t;
  using difference_type = std::ptrdiff_t;
  using reference = T&;
  using const_reference = const T&;
  using pointer = T*;
  using const_pointer = const T*;
  using iterator = T*;
  using const_iterator = const T*;
  using reverse_iterator = std::reverse_iterator<iterator>;
  using const_reverse_iterator = std::reverse_iterator<const_iterator>;

  SharedVector() noexcept = default;
  explicit SharedVector(size_type count, T value = T{}) : SharedVector(std::vector<T>(count, value)) {}
  SharedVector(std::initializer_list<T> values) : SharedVector(std::vector<T>(values)) {}
  template <std::input_iterator Iterator>
  SharedVector(Iterator first, Iterator last) : SharedVector(std::vector<T>(first, last)) {}
  SharedVector(std::vector<T> values) noexcept : own_(std::move(values)) { LookAtOwn(); }
  SharedVector(const SharedVector& from) : own_(from.own_), holder_(from.holder_) { LookAtOwnOr(from); }
  SharedVector(SharedVector&& from) noexcept
      : own_(std::move(from.own_)),
        holder_(std::move(from.holder_)),
        first_(std::exchange(from.first_, nullptr)),
        size_(std::exchange(from.size_, 0)) {
    from.own_.clear();
  }
  SharedVector& operator=(const SharedVector& from) {
    if (this == &from) return *this;
    own_ = from.own_;
    holder_ = from.holder_;
    LookAtOwnOr(from);
    return *this;
  }
  SharedVector& operator=(SharedVector&& from) noexcept {
    SharedVector moved(std::move(from));
    swap(moved);
    return *this;
  }
  SharedVector& operator=(std::initializer_list<T> values) {
    assign(values);
    return *this;
  }
  ~SharedVector() = default;
  // NOLINTNEXTLINE(google-explicit-constructor): a copy for those who want a vector
  operator std::vector<T>() const { return std::vector<T>(begin(), end()); }

  /// Looks at `count` numbers from `first` on, which stay as they are as long as anybody has `holder`. Memory of its own is
  /// given back. Precondition: there is a holder.
  void ReferTo(const T* first, size_type count, std::shared_ptr<const void> holder) noexcept {
    own_ = {};
    holder_ = std::move(holder);
    first_ = first;
    size_ = count;
  }
  /// Whether its elements are somebody else's.
  [[nodiscard]] bool is_reference() const noexcept { return holder_ != nullptr; }

  [[nodiscard]] size_type size() const noexcept { return size_; }
  [[nodiscard]] bool empty() const noexcept { return size_ == 0; }
  /// Of its own memory.
  [[nodiscard]] size_type capacity() const noexcept { return own_.capacity(); }

  [[nodiscard]] const T* data() const noexcept { return first_; }
  [[nodiscard]] const T* begin() const noexcept { return first_; }
  [[nodiscard]] const T* end() const noexcept { return first_ + size_; }
  [[nodiscard]] const T* cbegin() const noexcept { return begin(); }
  [[nodiscard]] const T* cend() const noexcept { return end(); }
  [[nodiscard]] auto rbegin() const noexcept { return const_reverse_iterator(end()); }
  [[nodiscard]] auto rend() const noexcept { return const_reverse_iterator(begin()); }
  [[nodiscard]] auto crbegin() const noexcept { return rbegin(); }
  [[nodiscard]] auto crend() const noexcept { return rend(); }
  [[nodiscard]] const T& operator[](size_type index) const noexcept { return first_[index]; }
  [[nodiscard]] const T& front() const noexcept { return first_[0]; }
  [[nodiscard]] const T& back() const noexcept { return first_[size_ - 1]; }
  [[nodiscard]] const T& at(size_type index) const { return first_[Checked(index)]; }

  /// These may be written to, so the elements become its own.
  [[nodiscard]] T* data() { return Writable(); }
  [[nodiscard]] T* begin() { return Writable(); }
  [[nodiscard]] T* end() { return Writable() + size_; }
  [[nodiscard]] auto rbegin() { return reverse_iterator(end()); }
  [[nodiscard]] auto rend() { return reverse_iterator(begin()); }
  [[nodiscard]] T& operator[](size_type index) { return Writable()[index]; }
  [[nodiscard]] T& front() { return Writable()[0]; }
  [[nodiscard]] T& back() { return Writable()[size_ - 1]; }
  [[nodiscard]] T& at(size_type index) { return Writable()[Checked(index)]; }

  void reserve(size_type count) {
    Change([&](auto& own) { own.reserve(count); });
  }
  void shrink_to_fit() {
    if (!is_reference()) Change([](auto& own) { own.shrink_to_fit(); });
  }
  void resize(size_type count) { resize(count, T{}); }
  void resize(size_type count, T value) {
    if (is_reference()) MakeOwn(count);
    Change([&](auto& own) { own.resize(count, value); });
  }
  void push_back(T value) {
    Change([&](auto& own) { own.push_back(value); });
  }
  T& emplace_back(T value = T{}) {
    push_back(value);
    return back();
  }
  void pop_back() {
    Change([](auto& own) { own.pop_back(); });
  }
  void clear() noexcept {
    Replace([](auto& own) { own.clear(); });
  }
  void assign(size_type count, T value) {
    Replace([&](auto& own) { own.assign(count, value); });
  }
  void assign(std::initializer_list<T> values) { assign(values.begin(), values.end()); }
  template <std::input_iterator Iterator>
  void assign(Iterator first, Iterator last) {
    Replace([&](auto& own) { own.assign(first, last); });
  }
  /// As std::vector's: a number, a count of one number, two iterators, a list of numbers.
  template <typename... What>
  T* insert(const T* before, What&&... what) {
    const difference_type index = before - first_;
    Change([&](auto& own) { own.insert(own.begin() + index, std::forward<What>(what)...); });
    return Writable() + index;
  }
  T* insert(const T* before, std::initializer_list<T> values) { return insert(before, values.begin(), values.end()); }
  T* erase(const T* at) { return erase(at, at + 1); }
  T* erase(const T* first, const T* last) {
    const difference_type index = first - first_;
    const difference_type count = last - first;
    Change([&](auto& own) { own.erase(own.begin() + index, own.begin() + index + count); });
    return Writable() + index;
  }
  void swap(SharedVector& other) noexcept {
    own_.swap(other.own_);
    holder_.swap(other.holder_);
    std::swap(first_, other.first_);
    std::swap(size_, other.size_);
  }
  friend void swap(SharedVector& one, SharedVector& other) noexcept { one.swap(other); }

  [[nodiscard]] friend bool operator==(const SharedVector& one, const SharedVector& other) noexcept {
    return std::equal(one.begin(), one.end(), other.begin(), other.end());
  }
  [[nodiscard]] friend bool operator==(const SharedVector& one, const std::vector<T>& other) noexcept {
    return std::equal(one.begin(), one.end(), other.begin(), other.end());
  }

 private:
  void LookAtOwn() noexcept {
    first_ = own_.data();
    size_ = own_.size();
  }
  void LookAtOwnOr(const SharedVector& from) noexcept {
    LookAtOwn();
    if (!is_reference()) return;
    first_ = from.first_;
    size_ = from.size_;
  }
  [[nodiscard]] T* Writable() {
    if (is_reference()) [[unlikely]]
      MakeOwn(size_);
    return const_cast<T*>(first_);  // of own_
  }
  // The first `most`: what goes anyway is not copied.
  [[gnu::noinline]] void MakeOwn(size_type most) {
    own_.assign(first_, first_ + std::min(most, size_));
    holder_.reset();
    LookAtOwn();
  }
  template <typename Action>
  void Change(Action&& change) {
    if (is_reference()) MakeOwn(size_);
    change(own_);
    LookAtOwn();
  }
  // With what is there no more needed, unless it is copied from, or there is no memory.
  template <typename Action>
  void Replace(Action&& replace) {
    replace(own_);
    holder_.reset();
    LookAtOwn();
  }
  [[nodiscard]] size_type Checked(size_type index) const {
    if (index >= size_) throw std::out_of_range("SharedVector::at");
    return index;
  }

  std::vector<T> own_;  // empty if it refers to others
  std::shared_ptr<const void> holder_;
  const T* first_ = nullptr;
  size_type size_ = 0;
};

}  // namespace runnel
