#pragma once

#include <cstddef>  // defines _GLIBCXX_USE_CXX11_ABI

namespace runnel {

/// Changes whenever a class that crosses the plugin boundary changes its layout or its meaning.
inline constexpr unsigned kPluginAbiVersion = 1;

/// What the code that includes this header was built with, as far as it decides whether C++ objects
/// can be handed over: compiler ABI, standard library, sanitizer, and the core's ABI version.
#define RUNNEL_STRINGIFY_INNER(text) #text
#define RUNNEL_STRINGIFY(text) RUNNEL_STRINGIFY_INNER(text)
#if defined(__SANITIZE_THREAD__)
#define RUNNEL_ABI_SANITIZER " thread-sanitizer"
#elif defined(__SANITIZE_ADDRESS__)
#define RUNNEL_ABI_SANITIZER " address-sanitizer"
#else
#define RUNNEL_ABI_SANITIZER ""
#endif
inline constexpr const char* kAbiFingerprint =
    "runnel-abi-1 gxx" RUNNEL_STRINGIFY(__GXX_ABI_VERSION) " cxx11abi" RUNNEL_STRINGIFY(
        _GLIBCXX_USE_CXX11_ABI) " pointer" RUNNEL_STRINGIFY(__SIZEOF_POINTER__)
        RUNNEL_ABI_SANITIZER;

/// The fingerprint of the core itself, as it was built.
[[nodiscard]] const char* CoreAbiFingerprint() noexcept;

}  // namespace runnel
