#pragma once

namespace runnel::bench {

/// Nanoseconds of a short piece of work that keeps all adders of a core busy, the best of three. A thread
/// that shares its core, with a second thread of the processor or with another virtual machine,
/// takes up to twice as long for it, and as long for all else that is not waiting; a single fetch_add,
/// which is, shows nothing of it.
///
/// Cost: about 20 us. Threads: any; it says how the caller's core is just now.
[[nodiscard]] double ProbeCore();

}  // namespace runnel::bench
