# SPDX-License-Identifier: GPL-3.0-or-later
# Sourced with the folder of deps.sh: what Wine needs to run programs that find their libraries there and in the compiler.
export WINEPREFIX=$1/wine WINEDEBUG=-all
compiler_folder=$(dirname "$(x86_64-w64-mingw32-gcc-posix -print-file-name=libstdc++-6.dll)")
winepath=
for libraries in "$1/prefix/bin" "$compiler_folder" /usr/x86_64-w64-mingw32/lib; do
    winepath+="Z:${libraries//\//\\};"
done
export WINEPATH=$winepath
