#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Builds what Pellucid needs on Windows from Debian's source packages, with mingw: deps.sh FOLDER. FOLDER/prefix is for
# packaging/windows/toolchain.cmake. What has been built from the same recipe, version and tools is not built again.
set -euo pipefail
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
folder=$(mkdir -p "$1" && cd "$1" && pwd)
prefix=$folder/prefix
export PELLUCID_WINDOWS_PREFIX=$prefix
# What is built is the same to the bit whenever and wherever: it knows neither the time nor the folder. All is installed for
# /prefix, below $folder.
export SOURCE_DATE_EPOCH=1 DESTDIR=$folder
mingw=x86_64-w64-mingw32
jobs=$(nproc)

# Name, Debian's version, and what it is built with. apt checks what it fetches against the archive's signed lists. If Debian no
# longer has a version, put its successor here.
recipes=(
    "libpng1.6 1.6.39-2+deb12u5"
    "xxhash 0.8.1-1"
    "fmtlib 9.1.0+ds1-2"
    "spdlog 1:1.10.0+ds-0.4 fmtlib"
    "googletest 1.12.1-0.2"
    "highway 1.0.3-3+deb12u1"
    "onetbb 2021.8.0-2+deb12u1"
    "fftw3 3.3.10-1"
    "libepoxy 1.5.10-1"
    "openjpeg2 2.5.0-2+deb12u3"
    "brotli 1.0.9-2"
    "lcms2 2.14-2+deb12u1"
    "jpeg-xl 0.7.0-10+deb12u1 highway brotli lcms2"
    "libarchive 3.6.2-1+deb12u5"
    "sqlite3 3.40.1-2+deb12u2"
    "openssl 3.0.20-1~deb12u2"
    "curl 7.88.1-10+deb12u15 openssl"
    "dcmtk 3.6.7-9~deb12u4 openssl libpng1.6"
    "insighttoolkit5 5.2.1-5+deb12u1 libeigen3-dev"
    "qt6-base 6.4.2+dfsg-10 sqlite3 libpng1.6"
    "qtkeychain 0.15.0-1 qt6-base" # Debian 13
)
# Headers alone: Debian's own packages have them, and CMake's files for them.
header_packages=(libglm-dev nlohmann-json3-dev libcli11-dev libeigen3-dev)
# Built without Debian's patches, which not every mirror has.
unpatched=(libepoxy qtkeychain)

# ---- How each of them is built: in its source folder, $build being an empty folder.

libpng1.6() { with_cmake -DPNG_SHARED=OFF -DPNG_TESTS=OFF -DPNG_EXECUTABLES=OFF; }
xxhash() {
    with_cmake -S cmake_unofficial -DXXHASH_BUILD_XXHSUM=OFF
    sed -i 's|^prefix=.*|prefix=/prefix|' "$prefix/lib/pkgconfig/libxxhash.pc" # it says /usr
}
fmtlib() { with_cmake -DFMT_TEST=OFF -DFMT_DOC=OFF; }
spdlog() { with_cmake -DSPDLOG_FMT_EXTERNAL=ON -DSPDLOG_BUILD_EXAMPLE=OFF; }
googletest() { with_cmake; }
highway() { with_cmake -DBUILD_TESTING=OFF -DHWY_ENABLE_EXAMPLES=OFF; }
# A DLL: TBB must be in a process once.
onetbb() { with_cmake -DBUILD_SHARED_LIBS=ON -DTBB_TEST=OFF -DTBB_STRICT=OFF; }
# The instruction sets of Debian's own build, for the same digits.
fftw3() {
    with_configure --disable-doc --with-our-malloc --enable-threads --enable-sse2 --enable-avx
    with_configure --disable-doc --with-our-malloc --enable-threads --enable-sse2 --enable-avx --enable-single
}
# A DLL: it keeps its table of functions by thread, for which Windows must call it.
libepoxy() {
    with_meson --default-library shared -Degl=no -Dglx=no -Dx11=false -Dtests=false
    sed -i '/^Requires.private/d' "$prefix/lib/pkgconfig/epoxy.pc" # Windows has no file for its OpenGL
}
openjpeg2() { with_cmake -DBUILD_CODEC=OFF; }
brotli() {
    with_cmake
    # It builds both kinds; the linker would prefer the shared one.
    for name in common dec enc; do
        rm "$prefix/lib/libbrotli$name.dll.a" "$prefix/bin/libbrotli$name.dll"
        cp "$prefix/lib/libbrotli$name-static.a" "$prefix/lib/libbrotli$name.a"
    done
}
lcms2() { with_configure --without-jpeg --without-tiff; }
jpeg-xl() {
    with_cmake -DBUILD_TESTING=OFF -DJPEGXL_ENABLE_TOOLS=OFF -DJPEGXL_ENABLE_EXAMPLES=OFF -DJPEGXL_ENABLE_MANPAGES=OFF \
        -DJPEGXL_ENABLE_BENCHMARK=OFF -DJPEGXL_ENABLE_PLUGINS=OFF -DJPEGXL_ENABLE_SKCMS=OFF -DJPEGXL_ENABLE_SJPEG=OFF \
        -DJPEGXL_ENABLE_JNI=OFF -DJPEGXL_ENABLE_DOXYGEN=OFF -DJPEGXL_ENABLE_OPENEXR=OFF -DJPEGXL_FORCE_SYSTEM_BROTLI=ON \
        -DJPEGXL_FORCE_SYSTEM_LCMS2=ON -DJPEGXL_FORCE_SYSTEM_HWY=ON -DJPEGXL_STATIC=OFF
}
libarchive() {
    local without=() name
    for name in OPENSSL LZMA LZ4 ZSTD BZip2 LIBB2 EXPAT LIBXML2 ICONV CNG MBEDTLS NETTLE TAR CPIO CAT TEST; do
        without+=("-DENABLE_$name=OFF")
    done
    with_cmake "${without[@]}" -DPOSIX_REGEX_LIB=NONE
}
# Its one source file is made by programs of this machine.
sqlite3() {
    mkdir "$build"
    (cd "$build" && ../source/configure --prefix=/prefix --disable-readline && make sqlite3.c)
    $mingw-gcc-posix -O2 -DSQLITE_ENABLE_FTS5 -DSQLITE_ENABLE_COLUMN_METADATA -DSQLITE_THREADSAFE=1 -c "$build/sqlite3.c" -o "$build/sqlite3.o"
    $mingw-ar rcsD "$prefix/lib/libsqlite3.a" "$build/sqlite3.o"
    cp "$build/sqlite3.h" src/sqlite3ext.h "$prefix/include/"
    cp "$build/sqlite3.pc" "$prefix/lib/pkgconfig/"
}
openssl() {
    ./Configure mingw64 --cross-compile-prefix=$mingw- --prefix=/prefix --libdir=lib --openssldir=/openssl \
        no-shared no-tests no-engine CC=gcc-posix
    make -j"$jobs" build_sw
    make DESTDIR="$DESTDIR" install_dev
}
curl() {
    with_cmake -DBUILD_CURL_EXE=OFF -DCURL_USE_OPENSSL=ON -DHTTP_ONLY=ON -DCURL_USE_LIBSSH2=OFF -DCURL_USE_LIBPSL=OFF -DUSE_LIBIDN2=OFF \
        -DCURL_CA_BUNDLE=none -DCURL_CA_PATH=none -DENABLE_MANUAL=OFF -DENABLE_UNICODE=ON -DENABLE_THREADED_RESOLVER=ON
}
dcmtk() {
    # It copies OpenSSL's libraries from there; from everywhere, if it does not know where.
    mkdir -p "$build/none"
    with_cmake -DBUILD_APPS=OFF -DOPENSSL_BINDIR="$build/none" "-DDCMTK_MODULES=ofstd;oflog;dcmdata;dcmimgle;dcmimage;dcmjpeg;dcmjpls;dcmtls;dcmnet;dcmsr;dcmiod;dcmfg;dcmseg" \
        -DCMAKE_INSTALL_DATADIC=share/dcmtk -DDCMTK_DEFAULT_DICT=builtin -DDCMTK_ENABLE_PRIVATE_TAGS=ON -DDCMTK_ENABLE_STL=ON -DDCMTK_WITH_OPENSSL=ON -DDCMTK_WITH_ZLIB=ON \
        -DDCMTK_WITH_PNG=OFF -DDCMTK_WITH_TIFF=OFF -DDCMTK_WITH_XML=OFF -DDCMTK_WITH_ICONV=OFF -DDCMTK_WITH_ICU=OFF -DDCMTK_WITH_SNDFILE=OFF \
        -DDCMTK_WITH_DOXYGEN=OFF -DDCMTK_WITH_WRAP=OFF "-DWINE_CPP_RUNTIME=${compiler_folder//\//\\}"
}
insighttoolkit5() {
    local modules=() name
    for name in Common Smoothing AnisotropicSmoothing ConnectedComponents LabelMap MathematicalMorphology ImageGrid ImageGradient \
        ImageFeature BinaryMathematicalMorphology Thresholding Statistics RegistrationMethodsv4 Metricsv4 Optimizersv4 Transform \
        RegionGrowing IOGDCM IOMeta IONIFTI; do
        modules+=("-DModule_ITK$name=ON")
    done
    with_cmake "${modules[@]}" -DITK_BUILD_DEFAULT_MODULES=OFF -DITK_USE_SYSTEM_EIGEN=ON -DEigen3_DIR="$prefix/share/eigen3/cmake" -DBUILD_TESTING=OFF -DBUILD_EXAMPLES=OFF -DITK_LEGACY_REMOVE=OFF
}
# What Debian's "dfsg" source lacks: sqlite, and the header for pen tablets.
qt6-base() {
    with_cmake -DBUILD_SHARED_LIBS=ON -DQT_BUILD_EXAMPLES=OFF -DQT_BUILD_TESTS=OFF -DINPUT_opengl=desktop -DFEATURE_opengl_desktop=ON \
        -DFEATURE_sql_sqlite=ON -DFEATURE_system_sqlite=ON -DFEATURE_sql_odbc=OFF -DFEATURE_tabletevent=OFF -DFEATURE_dbus=OFF \
        -DFEATURE_icu=OFF -DFEATURE_glib=OFF -DFEATURE_zstd=OFF
}
qtkeychain() {
    sed -i 's|/utf-8||' CMakeLists.txt qtkeychain/CMakeLists.txt # an option of another compiler
    with_cmake -DBUILD_SHARED_LIBS=OFF -DBUILD_WITH_QT6=ON -DBUILD_TRANSLATIONS=OFF -DBUILD_TEST_APPLICATION=OFF
}

# ---- The ways to build.

with_cmake() {
    local source=(-S .)
    [[ ${1:-} != -S ]] || { source=(-S "$2"); shift 2; }
    cmake -G Ninja "${source[@]}" -B "$build" -DCMAKE_TOOLCHAIN_FILE="$here/toolchain.cmake" -DCMAKE_INSTALL_PREFIX=/prefix \
        -DCMAKE_BUILD_TYPE=Release -DBUILD_SHARED_LIBS=OFF -DCMAKE_POLICY_DEFAULT_CMP0074=NEW "$@"
    cmake --build "$build" --parallel "$jobs"
    cmake --install "$build"
}
with_configure() {
    rm -rf "$build"
    mkdir "$build"
    cd "$build"
    CC=$mingw-gcc-posix CFLAGS="-O2 -D_WIN32_WINNT=0x0A00 -Wa,-muse-unaligned-vector-move" ../source/configure --host=$mingw --prefix=/prefix \
        --disable-shared --enable-static "$@"
    make -j"$jobs"
    make install
    cd ../source
}
with_meson() {
    cat >"$folder/meson.ini" <<INI
[binaries]
c = '$mingw-gcc-posix'
ar = '$mingw-ar'
strip = '$mingw-strip'
pkgconfig = 'pkg-config'
[host_machine]
system = 'windows'
cpu_family = 'x86_64'
cpu = 'x86_64'
endian = 'little'
INI
    meson setup "$build" --cross-file "$folder/meson.ini" --prefix /prefix --libdir lib --buildtype release "$@"
    ninja -C "$build" install
}

# ---- Fetching and building what is missing.

# The machine's own list of packages, with sources in place of programs, and those of Debian 13 beside its own.
sources=$folder/sources
apt_options=(-o "Dir::Etc::sourcelist=$sources/sources.sources" -o Dir::Etc::sourceparts=- -o "Dir::State::lists=$sources/lists"
    -o "Dir::Cache=$sources/cache" -o APT::Sandbox::User="$(id -un)" -qq)
list_sources() {
    mkdir -p "$sources"/lists/partial "$sources"/cache
    {
        sed -s -e '$a\\' -e 's/^Types:.*/Types: deb-src/' -e 's/^\(Suites:.* bookworm\)\( .*\)\?$/\1 trixie\2/' /etc/apt/sources.list.d/*.sources 2>/dev/null || true
    } >"$sources/sources.sources"
    if [[ ! -s $sources/sources.sources ]]; then
        apt_options[1]="Dir::Etc::sourcelist=$sources/sources.list"
        cat /etc/apt/sources.list /etc/apt/sources.list.d/*.list 2>/dev/null | sed -n 's/^deb \(\[[^]]*\] \)\?/deb-src \1/p' |
            sed 'p; s/ bookworm / trixie /; t; d' >"$sources/sources.list"
    fi
    apt-get "${apt_options[@]}" update
    listed=1
}
fetch() { # NAME VERSION: unpacked, with Debian's patches, in $folder/work/NAME/source
    local name=$1 version=$2
    [[ -n ${listed:-} ]] || list_sources
    mkdir -p "$sources/$name"
    local file=${name}_${version#*:} which=()
    [[ " ${unpatched[*]} " != *" $name "* ]] || which=(--tar-only)
    (cd "$sources/$name" && apt-get "${apt_options[@]}" source --download-only "${which[@]}" "$name=$version") || {
        echo "deps.sh: Debian no longer has $name $version; it has: $(apt-cache "${apt_options[@]}" showsrc "$name" |
            sed -n 's/^Version: //p' | tr '\n' ' ')" >&2
        exit 1
    }
    if ((${#which[@]})); then
        mkdir "$folder/work/$name/source"
        tar -x -C "$folder/work/$name/source" --strip-components=1 -f "$sources/$name/${file%-*}".orig.tar.?z
    else
        dpkg-source --no-check -x "$sources/$name/$file.dsc" "$folder/work/$name/source" >/dev/null
    fi
}

keep_licence() { # NAME VERSION: for the packages
    local source=$folder/work/$1/source files
    mkdir -p "$prefix/share/licences"
    rm -f "$prefix/share/licences/$1"_*
    files=("$source"/debian/copyright)
    [[ -f ${files[0]} ]] || files=("$source"/COPYING*)
    cat "${files[@]}" >"$prefix/share/licences/${1}_$2"
}

# shellcheck source=wine.sh
source "$here/wine.sh" "$folder" # sets compiler_folder
common=$(declare -f with_cmake with_configure with_meson; grep -v '^#' "$here/toolchain.cmake"; $mingw-g++-posix --version)
declare -A digest
for package in "${header_packages[@]}"; do
    digest[$package]=$(dpkg-query -W -f '${Version}' "$package")
    dpkg -L "$package" | grep -E '^/usr/(include|share/cmake|share/eigen3|share/pkgconfig|lib/.*cmake)/' | while read -r file; do
        [[ ! -f $file ]] || install -C -D -m 644 "$file" "$prefix/${file#/usr/}"
    done
done
mkdir -p "$prefix/stamps"
for recipe in "${recipes[@]}"; do
    read -r name version needs <<<"$recipe"
    digest[$name]=$({ echo "$common $recipe"; declare -f "$name"; for need in $needs; do echo "${digest[$need]}"; done; } | sha256sum | cut -c -16)
    stamp=$prefix/stamps/$name
    [[ $(cat "$stamp" 2>/dev/null) != "${digest[$name]}" || ! -f $prefix/share/licences/${name}_$version ]] || continue
    echo "deps.sh: $name $version"
    started=$SECONDS
    rm -rf "$folder/work/$name" && mkdir -p "$folder/work/$name"
    fetch "$name" "$version"
    keep_licence "$name" "$version"
    set +e # within a condition, the recipe would not stop at what fails
    (
        set -e
        build=$folder/work/$name/build
        cd "$folder/work/$name/source"
        "$name"
    ) >"$folder/work/$name.log" 2>&1
    status=$?
    set -e
    if ((status)); then
        tail -30 "$folder/work/$name.log"
        echo "deps.sh: $name failed: $folder/work/$name.log" >&2
        exit 1
    fi
    rm -rf "$folder/work/$name"
    echo "${digest[$name]}" >"$stamp"
    echo "deps.sh: $name took $((SECONDS - started)) s"
done
for stamp in "$prefix"/stamps/*; do # of recipes that are gone
    name=${stamp##*/}
    [[ -n ${digest[$name]:-} ]] || rm -f "$stamp" "$prefix/share/licences/${name}_"*
done
