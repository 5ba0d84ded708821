# SPDX-License-Identifier: GPL-3.0-or-later
# Cross-compiles for Windows on x86-64, with Debian's mingw-w64. PELLUCID_WINDOWS_PREFIX: what deps.sh built.
set(CMAKE_SYSTEM_NAME Windows)
set(CMAKE_SYSTEM_PROCESSOR x86_64)
set(mingw x86_64-w64-mingw32)
set(CMAKE_C_COMPILER ${mingw}-gcc-posix)
set(CMAKE_CXX_COMPILER ${mingw}-g++-posix)
set(CMAKE_RC_COMPILER ${mingw}-windres)
# What configuring and the tests run.
set(CMAKE_CROSSCOMPILING_EMULATOR wine)

set(PELLUCID_WINDOWS_PREFIX $ENV{PELLUCID_WINDOWS_PREFIX})
get_filename_component(folder ${PELLUCID_WINDOWS_PREFIX} DIRECTORY)
set(CMAKE_FIND_ROOT_PATH ${PELLUCID_WINDOWS_PREFIX} /usr/${mingw})
set(CMAKE_FIND_ROOT_PATH_MODE_PROGRAM NEVER)
set(CMAKE_FIND_ROOT_PATH_MODE_LIBRARY ONLY)
set(CMAKE_FIND_ROOT_PATH_MODE_INCLUDE ONLY)
set(CMAKE_FIND_ROOT_PATH_MODE_PACKAGE ONLY)
set(QT_HOST_PATH /usr)
set(QT_HOST_PATH_CMAKE_DIR /usr/lib/x86_64-linux-gnu/cmake)
set(ENV{PKG_CONFIG_LIBDIR} ${PELLUCID_WINDOWS_PREFIX}/lib/pkgconfig)
set(ENV{PKG_CONFIG_PATH} "")
set(ENV{PKG_CONFIG_SYSROOT_DIR} ${folder})
set(PKG_CONFIG_ARGN --static)

# Windows 10. All libraries are static, except Qt, TBB, libepoxy, libarchive, zlib and the compiler's.
set(definitions "-D_WIN32_WINNT=0x0A00 -DWINVER=0x0A00 -DNTDDI_VERSION=0x0A000006 -DOPJ_STATIC -DLIBARCHIVE_STATIC -DCURL_STATICLIB -DJXL_STATIC_DEFINE")
# On Windows, GCC aligns no variable of the stack to more than 16 bytes, but moves vectors as if it did (its bug 54412): the
# assembler writes these moves as unaligned ones, which cost nothing on aligned addresses.
set(flags "${definitions} -Wa,-muse-unaligned-vector-move -ffile-prefix-map=${folder}=.")
set(CMAKE_C_FLAGS_INIT ${flags})
# It also takes for granted which registers an inline function of a header leaves alone, although the linker may keep another
# file's copy of it, with other options: not so on Linux, where such functions can be replaced.
set(CMAKE_CXX_FLAGS_INIT "${flags} -fno-ipa-ra")
# Two builds are the same to the bit.
foreach(kind EXE SHARED MODULE)
    set(CMAKE_${kind}_LINKER_FLAGS_INIT -Wl,--no-insert-timestamp)
endforeach()
unset(folder)
unset(definitions)
unset(flags)
