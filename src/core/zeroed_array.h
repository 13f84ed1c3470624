// A large array of zeros that takes memory only where it is written to.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <memory>
#include <new>
#include <span>
#include <type_traits>

namespace nephroid {

enum class Pages : uint8_t {
  kHuge,  ///< 2 MB: quick where most of an array is written to, as few pages must be backed
  kSmall  ///< 4 KB: little memory where only few items are written to
};
/// Asks the system for pages of this size. A small page that is read before it is written to is
/// first a shared page of zeros, and replacing that stops all threads.
void prefer_pages(Pages pages, void* memory, size_t bytes);

/// A fixed number of items, initially all bits zero. The system backs pages when they are first
/// written to, so zeros cost neither memory nor time.
template <class T>
class ZeroedArray {
  static_assert(std::is_trivially_copyable_v<T> && std::is_trivially_destructible_v<T>);
  static_assert(alignof(T) <= alignof(std::max_align_t));

 public:
  ZeroedArray() = default;
  /// Throws std::bad_alloc.
  explicit ZeroedArray(size_t size, Pages pages = Pages::kHuge)
      : items_(static_cast<T*>(std::calloc(size, sizeof(T)))), size_(size) {
    if (size > 0 && !items_) throw std::bad_alloc();
    prefer_pages(pages, items_.get(), size * sizeof(T));
  }

  ZeroedArray(ZeroedArray&&) noexcept = default;
  ZeroedArray& operator=(ZeroedArray&&) noexcept = default;
  ZeroedArray(const ZeroedArray& other) : ZeroedArray(other.size_) {
    std::copy(other.begin(), other.end(), begin());
  }
  ZeroedArray& operator=(const ZeroedArray& other) { return *this = ZeroedArray(other); }

  size_t size() const { return size_; }
  bool empty() const { return size_ == 0; }
  T& operator[](size_t i) { return items_.get()[i]; }
  const T& operator[](size_t i) const { return items_.get()[i]; }
  T* begin() { return items_.get(); }
  T* end() { return items_.get() + size_; }
  const T* begin() const { return items_.get(); }
  const T* end() const { return items_.get() + size_; }
  std::span<T> items() { return {items_.get(), size_}; }

 private:
  struct Free {
    void operator()(T* items) const { std::free(items); }
  };
  std::unique_ptr<T[], Free> items_;
  size_t size_ = 0;
};

}  // namespace nephroid
