// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/platform/confinement.h"

#include <algorithm>
#include <cerrno>
#include <cstddef>
#include <fcntl.h>
#include <linux/landlock.h>
#include <sched.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/socket.h>
#include <sys/syscall.h>
#include <unistd.h>
#include <vector>

#include <seccomp.h>

#include "core/platform/memory.h"

namespace pellucid::platform {

namespace {

// A system call that is allowed with this second argument only.
struct AllowedCommand {
    int call = 0, argument = 0;
};

// The calls of one kind of helper, in addition to those of all.
struct Calls {
    std::vector<int> calls;
    std::vector<AllowedCommand> commands;
};

// Not newfstatat, which tells what any path leads to.
Calls callsOf(Talks talks) {
    switch (talks) {
    case Talks::throughItsSocket:
        return {{SCMP_SYS(poll), SCMP_SYS(ppoll), SCMP_SYS(select), SCMP_SYS(pselect6),
                 SCMP_SYS(recvfrom), SCMP_SYS(readv), SCMP_SYS(writev), SCMP_SYS(pwrite64),
                 SCMP_SYS(shutdown), SCMP_SYS(setsockopt), SCMP_SYS(getsockopt),
                 SCMP_SYS(getpeername), SCMP_SYS(getsockname), SCMP_SYS(lseek),
                 SCMP_SYS(clock_nanosleep), SCMP_SYS(nanosleep)},
                // Not the commands that send signals.
                {{SCMP_SYS(fcntl), F_GETFD},
                 {SCMP_SYS(fcntl), F_SETFD},
                 {SCMP_SYS(fcntl), F_GETFL},
                 {SCMP_SYS(fcntl), F_SETFL}}};
    case Talks::toThoseWhoConnect:
        return {{SCMP_SYS(poll), SCMP_SYS(ppoll), SCMP_SYS(recvfrom), SCMP_SYS(accept4),
                 SCMP_SYS(lseek)},
                // To shut the other direction of a listening socket would free it to connect.
                {{SCMP_SYS(shutdown), SHUT_WR}}};
    case Talks::toTheProgram:
        break;
    }
    return {};
}

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
    for (const int call : {SCMP_SYS(read),
                           SCMP_SYS(write),
                           SCMP_SYS(recvmsg),
                           SCMP_SYS(close),
                           SCMP_SYS(munmap),
                           SCMP_SYS(mremap),
                           SCMP_SYS(madvise),
                           SCMP_SYS(brk),
                           SCMP_SYS(futex),
                           SCMP_SYS(rt_sigreturn),
                           SCMP_SYS(rt_sigprocmask),
                           SCMP_SYS(rt_sigaction),
                           SCMP_SYS(sigaltstack),
                           SCMP_SYS(getpid),
                           SCMP_SYS(gettid),
                           SCMP_SYS(exit),
                           SCMP_SYS(exit_group),
                           SCMP_SYS(clock_gettime),
                           SCMP_SYS(gettimeofday),
                           SCMP_SYS(time),
                           SCMP_SYS(getrandom),
                           SCMP_SYS(setitimer),
                           SCMP_SYS(sched_yield),
                           SCMP_SYS(getrlimit),
                           SCMP_SYS(restart_syscall),
                           SCMP_SYS(getppid)})
        failed |= ::seccomp_rule_add(filter, SCMP_ACT_ALLOW, call, 0);
    // Only to where a socket is connected: with an address, or with this flag, sending connects.
    // Not sendmsg, whose address the filter cannot see.
    failed |=
        ::seccomp_rule_add(filter, SCMP_ACT_ALLOW, SCMP_SYS(sendto), 2,
                           SCMP_A3(SCMP_CMP_MASKED_EQ, MSG_FASTOPEN, 0), SCMP_A4(SCMP_CMP_EQ, 0));
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
int killForbiddenCalls(scmp_filter_ctx filter, const std::vector<int> &allowed) {
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

bool limitResources(const Needs &needs) {
    preferOutOfMemoryKill();
    bool holds = limit(RLIMIT_CORE, 0) && limit(RLIMIT_NPROC, 0) && limit(RLIMIT_MEMLOCK, 0);
#ifndef PELLUCID_SANITIZED // sanitizers reserve terabytes and write reports
    holds = limit(RLIMIT_FSIZE, needs.fileBytes) && holds;
    // Limits private memory; files and an arena, which the parent fills, do not count.
    holds = limit(RLIMIT_DATA, needs.memoryBytes) && holds;
    hideMemory();
#else
    (void)needs;
#endif
    return holds;
}

bool filterCalls(const Needs &needs) {
    const scmp_filter_ctx filter = ::seccomp_init(SCMP_ACT_ERRNO(EPERM));
    if (filter == nullptr)
        return false;
    int failed = allowCalls(filter);
    const Calls more = callsOf(needs.talks);
    for (const int call : more.calls)
        failed |= ::seccomp_rule_add(filter, SCMP_ACT_ALLOW, call, 0);
    for (const AllowedCommand &command : more.commands)
        failed |= ::seccomp_rule_add(filter, SCMP_ACT_ALLOW, command.call, 1,
                                     SCMP_A1(SCMP_CMP_EQ, scmp_datum_t(command.argument)));
    failed |= allowMemory(filter);
    failed |= killForbiddenCalls(filter, more.calls);
    failed |= ::seccomp_load(filter); // also forbids new privileges
    ::seccomp_release(filter);
    return failed == 0;
}

// The attributes of Landlock's sixth version; the system's header may be older than the kernel.
struct LandlockRules {
    std::uint64_t files = 0, network = 0, scopes = 0;
};

// Everything that this kernel's Landlock can forbid.
bool forbidFilesAndPorts() {
    const long version =
        ::syscall(SYS_landlock_create_ruleset, nullptr, 0, LANDLOCK_CREATE_RULESET_VERSION);
    if (version < 1)
        return false;
    // Since the first version: all but the last three; moving to other folders, truncating, device
    // commands. An open file keeps the rights that it was opened with.
    constexpr int firstRights = 13;
    LandlockRules rules;
    rules.files =
        (std::uint64_t(1) << (firstRights + (version >= 2) + (version >= 3) + (version >= 5))) - 1;
    if (version >= 4)
        rules.network = 3; // binding and connecting TCP sockets
    if (version >= 6)
        rules.scopes = 3; // abstract sockets of other processes, and signals to them
    const std::size_t size = version >= 6   ? sizeof rules
                             : version >= 4 ? offsetof(LandlockRules, scopes)
                                            : offsetof(LandlockRules, network);
    const int ruleset = int(::syscall(SYS_landlock_create_ruleset, &rules, size, 0));
    if (ruleset < 0)
        return false;
    const bool isForbidden = ::prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0) == 0 &&
                             ::syscall(SYS_landlock_restrict_self, ruleset, 0) == 0;
    ::close(ruleset);
    return isForbidden;
}

} // namespace

int confine(const Needs &needs) {
    const bool holds = limitResources(needs);
    // With a namespace of users of its own, because only there an ordinary user may leave a
    // network, and because the privileges of root end there.
    const bool hasNoNetwork = ::unshare(CLONE_NEWUSER | CLONE_NEWNET) == 0 ||
                              ::unshare(CLONE_NEWNET) == 0; // root, where there are no such ones
    const bool hasNoFiles = forbidFilesAndPorts();
    const bool isFiltered = filterCalls(needs);
    return (holds ? limitsHold : 0) | (isFiltered ? callsAreFiltered : 0) |
           (hasNoFiles ? filesAreFiltered : 0) | (hasNoNetwork ? networkIsEmpty : 0);
}

} // namespace pellucid::platform
