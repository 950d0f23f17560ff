#pragma once

namespace runnel::bench {

/// Seconds of computing time that all threads of this process have used.
[[nodiscard]] double ProcessSeconds();
/// The most memory that this process has had resident, in MB (10^6 bytes). Not getrusage's figure,
/// which a process inherits from the one that started it.
[[nodiscard]] double PeakMegabytes();

}  // namespace runnel::bench
