"""Python without what POSIX alone has, as on Windows, in a process and in all that it starts.

Put this folder first on PYTHONPATH. Python runs `sitecustomize` before everything else.
"""

from __future__ import annotations

import os
import signal
import socket
import sys

MODULES = {
    *("crypt", "fcntl", "grp", "nis", "posixshmem", "pty", "pwd", "readline", "resource", "spwd", "syslog"),
    *("termios", "tty"),
}
# What stays, because libraries call it where `sys.platform` is Linux's: `os.uname` (numpy), `os.getuid`
# (platformdirs), `os.fchmod` (filelock), `signal.SIGKILL` (subprocess).
IN_OS = (
    *("chown", "fchown", "fork", "forkpty", "getegid", "geteuid", "getgid", "getgroups"),
    *("getloadavg", "getpgid", "getpgrp", "getsid", "initgroups", "killpg", "lchown", "mkfifo", "mknod"),
    *("nice", "openpty", "pathconf", "posix_spawn", "sched_getaffinity", "sched_setaffinity", "setgid"),
    *("setpgid", "setsid", "setuid", "sync", "sysconf", "tcgetpgrp", "wait", "wait3", "wait4", "O_NONBLOCK"),
)
IN_SIGNAL = (
    *("SIGALRM", "SIGCHLD", "SIGCONT", "SIGHUP", "SIGPIPE", "SIGQUIT", "SIGSTOP", "SIGTSTP"),
    *("SIGUSR1", "SIGUSR2", "SIGWINCH", "SIGXCPU", "alarm", "pause", "pthread_kill", "pthread_sigmask"),
    *("setitimer", "sigpending", "sigwait"),
)
IN_SOCKET = ("SCM_RIGHTS",)
"""What `multiprocessing` asks for before it offers a server that forks."""

for module in MODULES:
    sys.modules[module] = None  # type: ignore[assignment]  # so that the import fails
for holder, names in ((os, IN_OS), (signal, IN_SIGNAL), (socket, IN_SOCKET)):
    for name in names:
        if hasattr(holder, name):
            delattr(holder, name)
