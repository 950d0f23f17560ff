#include "core/port/distribution.h"

namespace runnel::internal {

template class Distribution<QueuedReference>;
template class Distribution<QueuedCopy<1, 1>>;
template class Distribution<QueuedCopy<4, 4>>;
template class Distribution<QueuedCopy<8, 8>>;
template class Distribution<QueuedCopy<16, 8>>;
template class Distribution<QueuedCopy<24, 8>>;
template class Distribution<QueuedCopy<32, 8>>;

}  // namespace runnel::internal
