# SPDX-License-Identifier: GPL-3.0-or-later
# Sourced with the folder of deps.sh: what Wine needs to run programs that find their libraries there and in the compiler.
# Without winemenubuilder, which would add file types and menu entries to this machine's desktop.
export WINEPREFIX=$1/wine WINEDEBUG=-all WINEDLLOVERRIDES="winemenubuilder.exe=d"
if [[ ! -f $WINEPREFIX/is_set_up ]]; then # by default it is Windows 7, asks about crashes and uses a font with serifs
    {
        wineboot --init && wine winecfg -v win10 &&
            wine reg add 'HKCU\Software\Wine\WineDbg' /v ShowCrashDialog /t REG_DWORD /d 0 /f &&
            wine reg add 'HKCU\Software\Wine\Fonts\Replacements' /v 'MS Shell Dlg' /d 'DejaVu Sans' /f &&
            wine reg add 'HKCU\Software\Wine\Fonts\Replacements' /v 'Segoe UI' /d 'DejaVu Sans' /f &&
            touch "$WINEPREFIX/is_set_up"
    } >"$1/wine.log" 2>&1 || { echo "wine.sh: Wine cannot be set up: $1/wine.log" >&2; exit 1; }
fi
compiler_folder=$(dirname "$(x86_64-w64-mingw32-gcc-posix -print-file-name=libstdc++-6.dll)")
winepath=
for libraries in "$1/prefix/bin" "$compiler_folder" /usr/x86_64-w64-mingw32/lib; do
    winepath+="Z:${libraries//\//\\};"
done
export WINEPATH=$winepath
