// Runs a command, `test_old_kernel PROGRAM ARGUMENT ...`, as on Linux 3.2: what was added to the kernel since
// answers that there is no such call, filters of calls (seccomp) among it. All that the command starts is
// under the same rule.
#include <linux/filter.h>
#include <linux/seccomp.h>
#include <sys/prctl.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <cerrno>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <vector>

namespace {

// With the version that brought each. glibc 2.36 asks for most of them and makes do without; Landlock's have
// no names in all headers.
constexpr long k_newer_calls[] = {
    SYS_kcmp,               // 3.5
    SYS_finit_module,       // 3.8
    SYS_sched_setattr,      // 3.14
    SYS_sched_getattr,      // 3.14
    SYS_renameat2,          // 3.15
    SYS_seccomp,            // 3.17
    SYS_getrandom,          // 3.17
    SYS_memfd_create,       // 3.17
    SYS_bpf,                // 3.18
    SYS_execveat,           // 3.19
    SYS_userfaultfd,        // 4.3
    SYS_membarrier,         // 4.3
    SYS_mlock2,             // 4.4
    SYS_copy_file_range,    // 4.5
    SYS_preadv2,            // 4.6
    SYS_pwritev2,           // 4.6
    SYS_statx,              // 4.11
    SYS_rseq,               // 4.18
    SYS_pidfd_send_signal,  // 5.1
    SYS_io_uring_setup,     // 5.1
    SYS_pidfd_open,         // 5.3
    SYS_clone3,             // 5.3
    SYS_openat2,            // 5.6
    SYS_faccessat2,         // 5.8
    SYS_close_range,        // 5.9
    444,                    // 5.13, landlock_create_ruleset
};

constexpr auto k_of_word = static_cast<std::uint32_t>(offsetof(seccomp_data, nr));
constexpr auto k_of_first_argument = static_cast<std::uint32_t>(offsetof(seccomp_data, args));

sock_filter load(std::uint32_t offset) {
  return BPF_STMT(BPF_LD | BPF_W | BPF_ABS, offset);
}
sock_filter answer(std::uint32_t what) {
  return BPF_STMT(BPF_RET | BPF_K, what);
}
/// Skips `skip` instructions where the loaded word is another one.
sock_filter unless_equal(long value, unsigned char skip) {
  return BPF_JUMP(BPF_JMP | BPF_JEQ | BPF_K, static_cast<std::uint32_t>(value), 0, skip);
}

std::vector<sock_filter> filter() {
  std::vector<sock_filter> program = {load(k_of_word)};
  for (const long call : k_newer_calls) {
    program.push_back(unless_equal(call, 1));
    program.push_back(answer(SECCOMP_RET_ERRNO | ENOSYS));
  }
  // The same by prctl(): filters and the promise that goes before them are of 3.5.
  program.push_back(unless_equal(SYS_prctl, 5));
  program.push_back(load(k_of_first_argument));
  program.push_back(unless_equal(PR_SET_SECCOMP, 1));
  program.push_back(answer(SECCOMP_RET_ERRNO | EINVAL));
  program.push_back(unless_equal(PR_SET_NO_NEW_PRIVS, 1));
  program.push_back(answer(SECCOMP_RET_ERRNO | EINVAL));
  program.push_back(answer(SECCOMP_RET_ALLOW));
  return program;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 2) return 2;
  std::vector<sock_filter> program = filter();
  const sock_fprog whole{static_cast<unsigned short>(program.size()), program.data()};
  if (prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0) != 0 ||
      prctl(PR_SET_SECCOMP, SECCOMP_MODE_FILTER, &whole) != 0) {
    std::perror("test_old_kernel: no filter of system calls");
    return 77;  // skipped
  }
  execv(argv[1], argv + 1);
  std::perror(argv[1]);
  return 2;
}
