// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/parse/serve.h"

#include <cstdint>
#include <fcntl.h>
#include <initializer_list>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <unistd.h>

#include <seccomp.h>

#include "core/decoder/message.h"
#include "core/system/memory.h"

namespace pellucid::parse {

namespace {

bool limit(int what, std::uint64_t most) {
    const rlimit both{most, most};
    return ::setrlimit(__rlimit_resource_t(what), &both) == 0;
}

// If memory runs out all the same, this process is killed before the program that started it.
void preferOutOfMemoryKill() {
    const int fd = ::open("/proc/self/oom_score_adj", O_WRONLY | O_CLOEXEC);
    if (fd < 0)
        return;
    (void)!::write(fd, "1000", 4);
    ::close(fd);
}

bool limitResources() {
    preferOutOfMemoryKill();
    bool holds = limit(RLIMIT_CORE, 0) && limit(RLIMIT_NPROC, 0) && limit(RLIMIT_MEMLOCK, 0);
#ifndef PELLUCID_SANITIZED // sanitizers reserve terabytes and write reports
    holds = limit(RLIMIT_FSIZE, 0) && holds;
    // Limits private memory; files and the arena, which the parent fills, do not count.
    holds = limit(RLIMIT_DATA, system::freeMemoryBytes()) && holds;
    ::prctl(PR_SET_DUMPABLE, 0); // only root may debug it
#endif
    return holds;
}

// Each call returns 0 if the filter accepted all of its rules.
int allowCalls(scmp_filter_ctx filter) {
    int failed = 0;
    for (const int call : {SCMP_SYS(read),          SCMP_SYS(write),
                           SCMP_SYS(sendmsg),       SCMP_SYS(recvmsg),
                           SCMP_SYS(close),         SCMP_SYS(munmap),
                           SCMP_SYS(mremap),        SCMP_SYS(madvise),
                           SCMP_SYS(brk),           SCMP_SYS(futex),
                           SCMP_SYS(rt_sigreturn),  SCMP_SYS(rt_sigprocmask),
                           SCMP_SYS(rt_sigaction),  SCMP_SYS(sigaltstack),
                           SCMP_SYS(getpid),        SCMP_SYS(gettid),
                           SCMP_SYS(exit),          SCMP_SYS(exit_group),
                           SCMP_SYS(clock_gettime), SCMP_SYS(gettimeofday),
                           SCMP_SYS(time),          SCMP_SYS(getrandom),
                           SCMP_SYS(setitimer),     SCMP_SYS(sched_yield),
                           SCMP_SYS(getrlimit),     SCMP_SYS(restart_syscall),
                           SCMP_SYS(getppid)})
        failed |= ::seccomp_rule_add(filter, SCMP_ACT_ALLOW, call, 0);
    // abort()
    failed |= ::seccomp_rule_add(filter, SCMP_ACT_ALLOW, SCMP_SYS(tgkill), 1,
                                 SCMP_A0(SCMP_CMP_EQ, scmp_datum_t(::getpid())));
    return failed;
}

// Allows memory that is not executable and that the limit counts, or shared memory of a file.
int allowMemory(scmp_filter_ctx filter) {
    int failed = 0;
    failed |= ::seccomp_rule_add(filter, SCMP_ACT_ALLOW, SCMP_SYS(mprotect), 1,
                                 SCMP_A2(SCMP_CMP_MASKED_EQ, PROT_EXEC, 0));
    failed |= ::seccomp_rule_add(
        filter, SCMP_ACT_ALLOW, SCMP_SYS(mmap), 2, SCMP_A2(SCMP_CMP_MASKED_EQ, PROT_EXEC, 0),
        SCMP_A3(SCMP_CMP_MASKED_EQ, MAP_TYPE | MAP_GROWSDOWN, MAP_PRIVATE));
    failed |= ::seccomp_rule_add(
        filter, SCMP_ACT_ALLOW, SCMP_SYS(mmap), 2, SCMP_A2(SCMP_CMP_MASKED_EQ, PROT_EXEC, 0),
        SCMP_A3(SCMP_CMP_MASKED_EQ, MAP_TYPE | MAP_ANONYMOUS | MAP_GROWSDOWN, MAP_SHARED));
    return failed;
}

// No decoder ever makes these calls; an attempt means that it is compromised.
int killForbiddenCalls(scmp_filter_ctx filter) {
    int failed = 0;
    for (const int call : {SCMP_SYS(execve),
                           SCMP_SYS(execveat),
                           SCMP_SYS(fork),
                           SCMP_SYS(vfork),
                           SCMP_SYS(clone),
                           SCMP_SYS(clone3),
                           SCMP_SYS(ptrace),
                           SCMP_SYS(process_vm_readv),
                           SCMP_SYS(process_vm_writev),
                           SCMP_SYS(socket),
                           SCMP_SYS(socketpair),
                           SCMP_SYS(connect),
                           SCMP_SYS(bind),
                           SCMP_SYS(listen),
                           SCMP_SYS(accept),
                           SCMP_SYS(accept4),
                           SCMP_SYS(bpf),
                           SCMP_SYS(keyctl),
                           SCMP_SYS(io_uring_setup),
                           SCMP_SYS(open_by_handle_at),
                           SCMP_SYS(userfaultfd),
                           SCMP_SYS(perf_event_open),
                           SCMP_SYS(unshare),
                           SCMP_SYS(setns),
                           SCMP_SYS(mount)})
        failed |= ::seccomp_rule_add(filter, SCMP_ACT_KILL_PROCESS, call, 0);
    return failed;
}

// All other calls fail with EPERM, so a library that tries to read a table continues without it.
bool filterCalls() {
    const scmp_filter_ctx filter = ::seccomp_init(SCMP_ACT_ERRNO(EPERM));
    if (filter == nullptr)
        return false;
    int failed = allowCalls(filter);
    failed |= allowMemory(filter);
    failed |= killForbiddenCalls(filter);
    failed |= ::seccomp_load(filter); // also forbids new privileges
    ::seccomp_release(filter);
    return failed == 0;
}

} // namespace

int confine() {
    const bool holds = limitResources();
    const bool isFiltered = filterCalls();
    return (holds ? decoder::limitsHold : 0) | (isFiltered ? decoder::callsAreFiltered : 0);
}

} // namespace pellucid::parse
