# Builds for 64-bit ARM on another machine:
#   cmake --preset aarch64 -DAWAN_SYSROOT=FOLDER
# FOLDER is a Debian of that architecture with the libraries of server/packages.txt. While building, qemu-aarch64 runs one small
# program of ours that makes a table.
# tests/farm/aarch64.sh makes one and says which packages.
set(CMAKE_SYSTEM_NAME Linux)
set(CMAKE_SYSTEM_PROCESSOR aarch64)
set(CMAKE_CXX_COMPILER aarch64-linux-gnu-g++)
# Try-compiles read this file too.
list(APPEND CMAKE_TRY_COMPILE_PLATFORM_VARIABLES AWAN_SYSROOT)
set(CMAKE_SYSROOT "${AWAN_SYSROOT}")
# Programs (esbuild, pkg-config) are this machine's, all else is the sysroot's.
set(CMAKE_FIND_ROOT_PATH_MODE_PROGRAM NEVER)
set(CMAKE_FIND_ROOT_PATH_MODE_LIBRARY ONLY)
set(CMAKE_FIND_ROOT_PATH_MODE_INCLUDE ONLY)
set(CMAKE_FIND_ROOT_PATH_MODE_PACKAGE ONLY)
set(ENV{PKG_CONFIG_LIBDIR} "${AWAN_SYSROOT}/usr/lib/aarch64-linux-gnu/pkgconfig:${AWAN_SYSROOT}/usr/share/pkgconfig")
set(ENV{PKG_CONFIG_SYSROOT_DIR} "${AWAN_SYSROOT}")
set(CMAKE_CROSSCOMPILING_EMULATOR qemu-aarch64 -L "${AWAN_SYSROOT}")
