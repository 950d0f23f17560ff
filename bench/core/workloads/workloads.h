#pragma once

#include "bench/core/suite.h"

namespace runnel::bench {

// Each adds the cases of one group; what they do stands at the head of the file that has them.
void AddFetchAdd(Suite& suite);  // to every group
void AddBaselines(Suite& suite);
void AddRing(Suite& suite);
void AddPublish(Suite& suite);
void AddGet(Suite& suite);
void AddImage(Suite& suite);
void AddLease(Suite& suite);
void AddQueue(Suite& suite);
void AddLatency(Suite& suite);
void AddWakeUp(Suite& suite);
void AddPayload(Suite& suite);
void AddManyPorts(Suite& suite);
void AddConnecting(Suite& suite);
void AddImageTransport(Suite& suite);

}  // namespace runnel::bench
