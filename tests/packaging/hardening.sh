#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Programs have what stops an attack on a mistake of memory: addresses that differ at each start, a table of imports that
# nobody writes to, no executable stack, and checks of the stack, of the C library's functions, of containers and of jumps.
#   hardening.sh PROGRAM...
set -euo pipefail
export LC_ALL=C
for program; do
    lacks() {
        echo "$program: $*" >&2
        exit 1
    }
    dynamic=$(readelf -dW "$program") segments=$(readelf -lW "$program") imports=$(readelf -W --dyn-syms "$program")
    grep -q 'FLAGS_1.*PIE' <<<"$dynamic" || lacks "not position-independent"
    grep -q 'FLAGS.*NOW' <<<"$dynamic" || lacks "not bound at the start (BIND_NOW)"
    grep -q GNU_RELRO <<<"$segments" || lacks "no segment becomes read-only (RELRO)"
    grep -Eq 'GNU_STACK.* RW ' <<<"$segments" || lacks "an executable stack"
    grep -q ' UND __stack_chk_fail@' <<<"$imports" || lacks "no guard of the stack"
    grep -Eq ' UND __[a-z]+_chk@' <<<"$imports" || lacks "no checked function of the C library (FORTIFY)"
    grep -q ' UND .*glibcxx_assert_fail' <<<"$imports" || lacks "no checked container (_GLIBCXX_ASSERTIONS)"
    [[ $(readelf -hW "$program") == *X86-64* ]] || continue
    # The start files of the compiler alone have four.
    (($(objdump -d --no-show-raw-insn "$program" | grep -c endbr64) > 100)) || lacks "no marked targets of jumps (CET)"
    # The loader demands the marks only where every object has them, those of the C library, too.
    if ! readelf -nW "$program" | grep -q 'IBT, SHSTK'; then
        unmarked=
        for object in Scrt1.o crti.o crtn.o; do
            readelf -nW "$(cc -print-file-name=$object)" | grep -q 'IBT, SHSTK' || unmarked+=" $object"
        done
        [[ -n $unmarked ]] || lacks "no notes IBT and SHSTK, although the C library has them"
        echo "$program: no notes IBT and SHSTK, because the C library's$unmarked have none"
    fi
done
