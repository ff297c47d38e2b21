/// Filters of system calls by seccomp, and limits of memory.
#include "system/sandbox.hpp"

#include <fcntl.h>
#include <linux/audit.h>
#include <linux/filter.h>
#include <linux/seccomp.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/syscall.h>

#include <cerrno>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace solidus::sandbox {

namespace {

#if defined(__SANITIZE_ADDRESS__)
#define SOLIDUS_SHADOW_MEMORY
#elif defined(__has_feature)
#if __has_feature(address_sanitizer)
#define SOLIDUS_SHADOW_MEMORY
#endif
#endif
#ifdef SOLIDUS_SHADOW_MEMORY
constexpr bool k_limits_memory = false;
#else
constexpr bool k_limits_memory = true;
#endif

#if defined(__x86_64__)
constexpr std::uint32_t k_architecture = AUDIT_ARCH_X86_64;
#elif defined(__aarch64__)
constexpr std::uint32_t k_architecture = AUDIT_ARCH_AARCH64;
#else
constexpr std::uint32_t k_architecture = 0;
#endif

constexpr long k_refused[] = {
    SYS_execve,   SYS_execveat,       SYS_ptrace,   SYS_process_vm_writev,
    SYS_socket,   SYS_connect,        SYS_bind,     SYS_sendto,
    SYS_kill,     SYS_mount,          SYS_truncate, SYS_unlinkat,
    SYS_mkdirat,  SYS_symlinkat,      SYS_linkat,   SYS_renameat2,
    SYS_fchmodat, SYS_fchownat,       SYS_mknodat,  SYS_utimensat,
    SYS_setxattr, SYS_io_uring_setup, SYS_openat2,  SYS_name_to_handle_at,
#ifdef SYS_renameat
    SYS_renameat,
#endif
#if defined(__x86_64__)
    SYS_unlink,   SYS_mkdir,          SYS_rmdir,    SYS_rename,
    SYS_link,     SYS_symlink,        SYS_chmod,    SYS_chown,
    SYS_lchown,   SYS_mknod,          SYS_creat,    SYS_utime,
    SYS_utimes,   SYS_futimesat,
#endif
};

constexpr std::uint32_t k_refuse = SECCOMP_RET_ERRNO | EPERM;
constexpr std::uint32_t k_writing = O_ACCMODE | O_CREAT | O_TRUNC;

sock_filter load(std::size_t offset) {
  return BPF_STMT(BPF_LD | BPF_W | BPF_ABS, static_cast<std::uint32_t>(offset));
}
sock_filter answer(std::uint32_t what) {
  return BPF_STMT(BPF_RET | BPF_K, what);
}
/// Goes on with the next instruction where the loaded word is `value`, else skips `skip` of them.
sock_filter unless_equal(std::uint32_t value, unsigned char skip) {
  return BPF_JUMP(BPF_JMP | BPF_JEQ | BPF_K, value, 0, skip);
}

// The flags of open() and openat() are their second and third argument; the lower half of each is enough.
void refuse_to_open_for_writing(long call, std::size_t argument, std::vector<sock_filter>& program) {
  program.push_back(unless_equal(static_cast<std::uint32_t>(call), 4));
  program.push_back(load(offsetof(seccomp_data, args) + argument * sizeof(std::uint64_t)));
  program.push_back(BPF_JUMP(BPF_JMP | BPF_JSET | BPF_K, k_writing, 0, 1));
  program.push_back(answer(k_refuse));
  program.push_back(answer(SECCOMP_RET_ALLOW));
}

std::vector<sock_filter> filter_program() {
  // The filter looks at the architecture first, then at the number of the call. Opening is allowed for
  // reading alone; calls of the list are refused, all others pass.
  std::vector<sock_filter> program;
  program.push_back(load(offsetof(seccomp_data, arch)));
  program.push_back(BPF_JUMP(BPF_JMP | BPF_JEQ | BPF_K, k_architecture, 1, 0));
  program.push_back(answer(k_refuse));  // the calls of another architecture have other numbers
  // From here on the number of the call decides.
  program.push_back(load(offsetof(seccomp_data, nr)));
#if defined(__x86_64__)
  constexpr std::uint32_t k_x32 = 0x40000000;
  program.push_back(BPF_JUMP(BPF_JMP | BPF_JGE | BPF_K, k_x32, 0, 1));
  program.push_back(answer(k_refuse));
  refuse_to_open_for_writing(SYS_open, 1, program);
#endif
  refuse_to_open_for_writing(SYS_openat, 2, program);
  for (const long call : k_refused) {
    program.push_back(unless_equal(static_cast<std::uint32_t>(call), 1));
    program.push_back(answer(k_refuse));
  }
  program.push_back(answer(SECCOMP_RET_ALLOW));
  return program;
}

}  // namespace

void limit_memory(double memory) {
  const rlimit none{0, 0};
  setrlimit(RLIMIT_CORE, &none);
  if (memory <= 0 || !k_limits_memory) return;
  const rlimit limit{static_cast<rlim_t>(memory), static_cast<rlim_t>(memory)};
  setrlimit(RLIMIT_DATA, &limit);
}

void forbid_all_but_reading() {
  const rlimit small{1 << 20, 1 << 20};
  setrlimit(RLIMIT_FSIZE, &small);
  if (k_architecture == 0 || prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0) != 0) return;
  std::vector<sock_filter> program = filter_program();
  const sock_fprog whole{static_cast<unsigned short>(program.size()), program.data()};
  prctl(PR_SET_SECCOMP, SECCOMP_MODE_FILTER, &whole);
}

}  // namespace solidus::sandbox
