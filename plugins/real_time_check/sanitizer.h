#pragma once

// Sanitizers replace malloc and pthread functions themselves; what replaces them too steps aside.
#if defined(__SANITIZE_THREAD__) || defined(__SANITIZE_ADDRESS__)
#define RUNNEL_UNDER_SANITIZER 1
#else
#define RUNNEL_UNDER_SANITIZER 0
#endif
