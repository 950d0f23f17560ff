#pragma once

#include <cstddef>  // defines _GLIBCXX_USE_CXX11_ABI
#include <cstdint>

#include "core/plugin/plugin_registry.h"

namespace runnel {

#define RUNNEL_PLUGIN_ABI_VERSION 2
/// Changes whenever a class that crosses the plugin boundary changes its layout or its meaning.
inline constexpr unsigned kPluginAbiVersion = RUNNEL_PLUGIN_ABI_VERSION;

/// What the code that includes this header was built with, as far as it decides whether C++ objects
/// can be handed over: compiler ABI, standard library and its debug mode, sanitizer, the vector
/// instructions, by which Eigen chooses how its types are aligned, and the core's ABI version.
#define RUNNEL_STRINGIFY_INNER(text) #text
#define RUNNEL_STRINGIFY(text) RUNNEL_STRINGIFY_INNER(text)
#if defined(__SANITIZE_THREAD__)
#define RUNNEL_ABI_SANITIZER " thread-sanitizer"
#elif defined(__SANITIZE_ADDRESS__)
#define RUNNEL_ABI_SANITIZER " address-sanitizer"
#else
#define RUNNEL_ABI_SANITIZER ""
#endif
#if defined(_GLIBCXX_DEBUG)
#define RUNNEL_ABI_DEBUG " debug"
#else
#define RUNNEL_ABI_DEBUG ""
#endif
#if defined(__AVX512F__)
#define RUNNEL_ABI_VECTOR " avx512"
#elif defined(__AVX__)
#define RUNNEL_ABI_VECTOR " avx"
#else
#define RUNNEL_ABI_VECTOR ""
#endif
// clang-format off
inline constexpr const char* kAbiFingerprint =
    "runnel-abi-" RUNNEL_STRINGIFY(RUNNEL_PLUGIN_ABI_VERSION)
    " gxx" RUNNEL_STRINGIFY(__GXX_ABI_VERSION)
    " libstdcxx" RUNNEL_STRINGIFY(_GLIBCXX_RELEASE)
    " cxx11abi" RUNNEL_STRINGIFY(_GLIBCXX_USE_CXX11_ABI)
    " pointer" RUNNEL_STRINGIFY(__SIZEOF_POINTER__)
    RUNNEL_ABI_DEBUG RUNNEL_ABI_VECTOR RUNNEL_ABI_SANITIZER;
// clang-format on

/// The fingerprint of the core itself, as it was built.
[[nodiscard]] const char* CoreAbiFingerprint() noexcept;

/// What a plugin library exports. Plain data, so that it can be read before any C++ class of the
/// library is trusted. The first two members never change their place.
struct PluginEntry {
  std::uint32_t abi_version;
  std::uint32_t entry_size;  ///< sizeof(PluginEntry) as the plugin was built
  const char* fingerprint;   ///< kAbiFingerprint as the plugin was built
  const char* name;
  void (*register_plugin)(PluginRegistry&);
};

/// The name of the exported function, of type `const PluginEntry* ()`.
inline constexpr const char* kPluginEntrySymbol = "RunnelPluginEntry";

}  // namespace runnel

/// Defines the entry of a plugin library. Use it exactly once per library, in a .cpp file:
///
///     RUNNEL_PLUGIN(motion, registry) {
///       registry.Add<runnel::motion::CollisionGuard>("motion/collision_guard", "stops before
///       walls");
///     }
///
/// The function runs once, while the library is being loaded, on the loading thread. Exceptions
/// that it throws are reported as a failure to load the library, and nothing stays registered.
#define RUNNEL_PLUGIN(plugin_name, registry)                                                                          \
  static void RunnelRegister_##plugin_name(::runnel::PluginRegistry& registry);                                       \
  extern "C" __attribute__((visibility("default"))) const ::runnel::PluginEntry* RunnelPluginEntry() {                \
    static const ::runnel::PluginEntry entry{::runnel::kPluginAbiVersion, sizeof(::runnel::PluginEntry),              \
                                             ::runnel::kAbiFingerprint, #plugin_name, &RunnelRegister_##plugin_name}; \
    return &entry;                                                                                                    \
  }                                                                                                                   \
  static void RunnelRegister_##plugin_name([[maybe_unused]] ::runnel::PluginRegistry& registry)
