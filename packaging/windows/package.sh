#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Makes the installer, and a ZIP that needs no installation, of what is built: package.sh BUILD DEPS OUT. OUT/packages is the same to the bit for
# everybody. SOURCE_DATE_EPOCH: the time of all files. PELLUCID_WINDOWS_CERTIFICATE: a file of PKCS #12 to sign programs with,
# whose password is in the file PELLUCID_WINDOWS_PASSWORD. PELLUCID_WINDOWS_TIMESTAMPS: the address of a server that signs the time.
# Signed packages differ.
set -euo pipefail
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
sign() { # FILE...
    local file
    [[ -n ${PELLUCID_WINDOWS_CERTIFICATE:-} ]] || return 0
    for file in "$@"; do
        osslsigncode sign -pkcs12 "$PELLUCID_WINDOWS_CERTIFICATE" ${PELLUCID_WINDOWS_PASSWORD:+-readpass "$PELLUCID_WINDOWS_PASSWORD"} \
            -h sha256 -n Pellucid ${PELLUCID_WINDOWS_TIMESTAMPS:+-ts "$PELLUCID_WINDOWS_TIMESTAMPS"} -in "$file" -out "$file.signed" </dev/null >/dev/null
        mv "$file.signed" "$file"
    done
}
if [[ ${1:-} == --sign ]]; then # called by makensis
    sign "$2"
    exit
fi
for name in PELLUCID_WINDOWS_CERTIFICATE PELLUCID_WINDOWS_PASSWORD; do # makensis changes the folder
    [[ -z ${!name:-} ]] || export "$name=$(realpath "${!name}")"
done
build=$(realpath "$1") deps=$(realpath "$2") out=$(realpath -m "$3")
prefix=$deps/prefix tree=$out/tree
# shellcheck source=wine.sh
source "$here/wine.sh" "$deps" # sets compiler_folder
[[ -n ${PELLUCID_WINDOWS_CERTIFICATE:-} ]] || echo "package.sh: PELLUCID_WINDOWS_CERTIFICATE names no certificate: programs are not signed" >&2

rm -rf "$out"/{tree,packages,files.nsh,SHA256SUMS}
mkdir -p "$out/packages"
cmake --install "$build" --prefix "$tree" --strip >/dev/null
version=$(sed -n 's/^project(.* VERSION \([0-9.]*\).*/\1/p' "$here/../../CMakeLists.txt")
documents=$tree/share/doc/pellucid
cp "$here/../../LICENSE" "$here/../../CHANGELOG.md" "$documents"

# Qt's plugins and translation, and every library that is not a part of Windows: Wine has those that are.
for plugin in platforms/qwindows sqldrivers/qsqlite imageformats/qjpeg; do
    install -D -m 644 "$prefix/plugins/$plugin.dll" "$tree/plugins/$plugin.dll"
done
install -D -m 644 "$(/usr/lib/qt6/bin/qtpaths --query QT_INSTALL_TRANSLATIONS)/qtbase_zh_TW.qm" "$tree/translations/qtbase_zh_TW.qm"
printf '[Paths]\nPrefix=..\nPlugins=plugins\nTranslations=translations\n' >"$tree/bin/qt.conf"
added=1
while ((added)); do
    added=0
    while read -r name; do
        [[ ! -f $tree/bin/$name && $name != api-ms-win-* ]] || continue # those are names for parts of Windows
        for place in "$prefix/bin" "$compiler_folder" /usr/x86_64-w64-mingw32/lib none; do
            [[ ! -f $place/$name ]] || break
        done
        if [[ $place == none ]]; then
            [[ -f /usr/lib/x86_64-linux-gnu/wine/x86_64-windows/${name,,} ]] || { echo "package.sh: nothing has $name" >&2; exit 1; }
            continue
        fi
        install -m 644 "$place/$name" "$tree/bin/$name"
        added=1
    done < <(find "$tree" -name '*.exe' -o -name '*.dll' | xargs -d '\n' x86_64-w64-mingw32-objdump -p | sed -n 's/^\tDLL Name: //p' | sort -u)
done
find "$tree" -name '*.dll' -exec x86_64-w64-mingw32-strip --strip-unneeded {} +
find "$tree" -name '*.exe' -o -name '*.dll' | while read -r file; do sign "$file"; done
"$here/inventory.py" "$tree" "$version" "$prefix" "$documents/licences" "$documents/pellucid.spdx.json"

# The ZIP.
name=pellucid-$version
cp -r "$tree" "$out/$name"
chmod -R u=rwX,go=rX "$out/$name"
find "$out/$name" -exec touch -d "@$SOURCE_DATE_EPOCH" {} +
(cd "$out" && find "$name" -type f | LC_ALL=C sort | TZ=UTC zip -X -9 -q -@ "packages/$name-windows-x86_64.zip")
rm -r "${out:?}/$name"

# The installer.
{
    echo '!macro INSTALL_FILES'
    (cd "$tree" && find . -type d | LC_ALL=C sort) | while read -r folder; do
        inside=${folder#.} inside=${inside//\//\\}
        echo "SetOutPath \"\$INSTDIR$inside\""
        find "$tree/$folder" -maxdepth 1 -type f | LC_ALL=C sort | sed 's/.*/File "&"/'
    done
    echo '!macroend'
    echo '!macro REMOVE_FILES'
    (cd "$tree" && find . -type f | LC_ALL=C sort) | sed 's|^\./||; s|/|\\|g; s|.*|Delete "$INSTDIR\\&"|'
    (cd "$tree" && find . -mindepth 1 -type d | LC_ALL=C sort -r) | sed 's|^\./||; s|/|\\|g; s|.*|RMDir "$INSTDIR\\&"|'
    echo '!macroend'
} >"$out/files.nsh"
installer=$out/packages/$name-windows-x86_64.exe
makensis -V2 -WX -INPUTCHARSET UTF8 "-DVERSION=$version" "-DOUT=$installer" "-DFILES=$out/files.nsh" "-DICON=$build/app/pellucid.ico" \
    ${PELLUCID_WINDOWS_CERTIFICATE:+"-DSIGN=$here/package.sh"} "$here/installer.nsi"
sign "$installer"
(cd "$out/packages" && sha256sum -- *) | tee "$out/SHA256SUMS"
