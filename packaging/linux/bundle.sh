#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Makes an installed tree self-contained: copies libraries and Qt's plugins beside the programs, so that it runs from any
# folder. glibc, the display's libraries and OpenGL stay the machine's own.
#   bundle.sh TREE     TREE has bin, libexec, share
set -euo pipefail
tree=$1
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
plugins=$(/usr/lib/qt6/bin/qtpaths --query QT_INSTALL_PLUGINS)
translations=$(/usr/lib/qt6/bin/qtpaths --query QT_INSTALL_TRANSLATIONS)

# Not bundled: these must match the machine's kernel, display server and drivers, which have needs of their own (a newer
# libstdc++).
of_machine='^(linux-vdso|libstdc\+\+|libgcc_s|libz|ld-linux.*|libc|libm|libdl|librt|libpthread|libresolv|libnss_.*|libGL|libEGL|libGLX|libGLdispatch|libgbm|libdrm.*|libX11|libX11-xcb|libxcb|libxcb-dri.*|libxcb-glx|libwayland-.*|libfontconfig|libfreetype|libexpat)\.so'

# The services run /usr/bin/pellucid-cli: of another installation, they are examples.
mv "$tree/lib/systemd/system" "$tree/share/doc/pellucid/systemd"
rmdir "$tree/lib/systemd"
mkdir -p "$tree/lib" "$tree/plugins"
for plugin in platforms/libqxcb.so sqldrivers/libqsqlite.so xcbglintegrations/libqxcb-glx-integration.so \
    xcbglintegrations/libqxcb-egl-integration.so imageformats/libqjpeg.so platforminputcontexts/libibusplatforminputcontextplugin.so \
    platforminputcontexts/libcomposeplatforminputcontextplugin.so; do
    install -D -m 644 "$plugins/$plugin" "$tree/plugins/$plugin"
done
mkdir -p "$tree/translations"
install -m 644 "$translations/qtbase_zh_TW.qm" "$tree/translations/"
mkdir -p "$tree/share/pellucid"
found=$("$here/../dictionaries.sh" "$tree/libexec/pellucid/pellucid-decode")
mapfile -t dictionaries <<<"$found"
install -m 644 "${dictionaries[@]}" "$tree/share/pellucid"

programs() { find "$tree/bin" "$tree/libexec" "$tree/plugins" -type f \( -perm -u+x -o -name '*.so' \); }
if missing=$(programs | xargs -d '\n' ldd | grep 'not found'); then
    echo "bundle: $missing" >&2
    exit 1
fi
programs | while read -r program; do ldd "$program"; done | sed -nE 's#^\s*(\S+) => (/.*) \(0x.*#\1 \2#p' | sort -u |
    while read -r name path; do
        [[ $name =~ $of_machine ]] || cp -L "$path" "$tree/lib/$name"
    done
chmod 644 "$tree"/lib/*
# Printers are the machine's own: without its CUPS, Qt does not load this and offers a PDF file.
install -D -m 644 "$plugins/printsupport/libcupsprintersupport.so" "$tree/plugins/printsupport/libcupsprintersupport.so"

# Where each finds its libraries. DT_RPATH, the old tag, also applies to the dependencies of plugins.
find "$tree/bin" "$tree/libexec" "$tree/lib" "$tree/plugins" -type f | while read -r file; do
    [[ $(head -c 4 "$file") == $'\x7fELF' ]] || continue
    up=$(realpath --relative-to="$(dirname "$file")" "$tree/lib")
    patchelf --force-rpath --set-rpath "\$ORIGIN/$up" "$file"
done
for folder in bin libexec/pellucid; do
    printf '[Paths]\nPrefix=%s\nPlugins=plugins\nTranslations=translations\n' \
        "$(realpath --relative-to="$tree/$folder" "$tree")" >"$tree/$folder/qt.conf"
done
install -m 755 "$here/install.sh" "$here/uninstall.sh" "$tree"
