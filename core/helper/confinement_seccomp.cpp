// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/helper/confinement.h"

#include <algorithm>
#include <cerrno>
#include <fcntl.h>
#include <linux/landlock.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <seccomp.h>

namespace pellucid::helper {

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

// Only a compromised helper makes these calls, unless it is allowed to.
int killForbiddenCalls(scmp_filter_ctx filter, std::initializer_list<int> allowed) {
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
        if (std::find(allowed.begin(), allowed.end(), call) == allowed.end())
            failed |= ::seccomp_rule_add(filter, SCMP_ACT_KILL_PROCESS, call, 0);
    return failed;
}

} // namespace

bool limitResources(const ResourceLimits &limits) {
    preferOutOfMemoryKill();
    bool holds = limit(RLIMIT_CORE, 0) && limit(RLIMIT_NPROC, 0) && limit(RLIMIT_MEMLOCK, 0);
#ifndef PELLUCID_SANITIZED // sanitizers reserve terabytes and write reports
    holds = limit(RLIMIT_FSIZE, limits.fileBytes) && holds;
    // Limits private memory; files and an arena, which the parent fills, do not count.
    holds = limit(RLIMIT_DATA, limits.memoryBytes) && holds;
    ::prctl(PR_SET_DUMPABLE, 0); // only root may debug it
#else
    (void)limits;
#endif
    return holds;
}

bool filterCalls(std::initializer_list<int> more, std::initializer_list<AllowedCommand> commands) {
    const scmp_filter_ctx filter = ::seccomp_init(SCMP_ACT_ERRNO(EPERM));
    if (filter == nullptr)
        return false;
    int failed = allowCalls(filter);
    for (const int call : more)
        failed |= ::seccomp_rule_add(filter, SCMP_ACT_ALLOW, call, 0);
    for (const AllowedCommand &command : commands)
        failed |= ::seccomp_rule_add(filter, SCMP_ACT_ALLOW, command.call, 1,
                                     SCMP_A1(SCMP_CMP_EQ, scmp_datum_t(command.argument)));
    failed |= allowMemory(filter);
    failed |= killForbiddenCalls(filter, more);
    failed |= ::seccomp_load(filter); // also forbids new privileges
    ::seccomp_release(filter);
    return failed == 0;
}

bool forbidFiles() {
    // The rights of the first version of Landlock, which every kernel that has it knows; a later
    // version only adds rights, such as truncating, that need an open file.
    landlock_ruleset_attr all{};
    all.handled_access_fs = (std::uint64_t(LANDLOCK_ACCESS_FS_MAKE_SYM) << 1) - 1;
    const int rules = int(::syscall(SYS_landlock_create_ruleset, &all, sizeof all, 0));
    if (rules < 0)
        return false;
    const bool isForbidden = ::prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0) == 0 &&
                             ::syscall(SYS_landlock_restrict_self, rules, 0) == 0;
    ::close(rules);
    return isForbidden;
}

} // namespace pellucid::helper
