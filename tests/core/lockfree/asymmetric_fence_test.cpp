#include "core/lockfree/asymmetric_fence.h"

#include <cerrno>
#include <cstddef>

#include <gtest/gtest.h>
#include <linux/filter.h>
#include <linux/seccomp.h>
#include <sched.h>
#include <sys/prctl.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

namespace runnel {
namespace {

// From now on this process gets EPERM for an answer to membarrier().
bool RefuseMembarrier() {
  sock_filter filter[] = {
      BPF_STMT(BPF_LD | BPF_W | BPF_ABS, offsetof(seccomp_data, nr)),
      BPF_JUMP(BPF_JMP | BPF_JEQ | BPF_K, SYS_membarrier, 0, 1),
      BPF_STMT(BPF_RET | BPF_K, SECCOMP_RET_ERRNO | EPERM),
      BPF_STMT(BPF_RET | BPF_K, SECCOMP_RET_ALLOW),
  };
  const sock_fprog program{sizeof filter / sizeof *filter, filter};
  return prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0) == 0 && prctl(PR_SET_SECCOMP, SECCOMP_MODE_FILTER, &program, 0, 0) == 0;
}

enum Outcome { kPassed, kCannotBeRefused, kRunsElsewhere };

// What becomes of a process that is forked and then refused.
int OutcomeWhenRefused() {
  const pid_t child = fork();
  if (child == 0) {
    alarm(30);  // an endless loop ends by a signal
    if (!RefuseMembarrier()) _exit(kCannotBeRefused);
    cpu_set_t before, after;
    sched_getaffinity(0, sizeof before, &before);
    HeavyFence();
    sched_getaffinity(0, sizeof after, &after);
    _exit(CPU_EQUAL(&before, &after) != 0 ? kPassed : kRunsElsewhere);
  }
  int status = 0;
  waitpid(child, &status, 0);
  return WIFEXITED(status) ? WEXITSTATUS(status) : -WTERMSIG(status);
}

TEST(HeavyFence, PassesWhenTheKernelRefusesItsPartLater) {
  const int outcome = OutcomeWhenRefused();
  if (outcome == kCannotBeRefused) GTEST_SKIP() << "this machine filters no system calls";
  EXPECT_EQ(outcome, kPassed) << "negative: ended by this signal, 14 after 30 s";
}

}  // namespace
}  // namespace runnel
