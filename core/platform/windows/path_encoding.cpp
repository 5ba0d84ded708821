// SPDX-License-Identifier: GPL-3.0-or-later
#include <codecvt>
#include <locale>

// GCC 12 reads the narrow text of a std::filesystem::path by the C library's encoding, although it
// writes UTF-8 (its bug 95048, mended in 13). This definition takes the place of the one in its
// library, which nothing else here calls. A byte that begins no valid character becomes U+FFFD:
// names from files may have any.
namespace std {

codecvt_base::result codecvt<wchar_t, char, mbstate_t>::do_in(
    state_type &state, const extern_type *from, const extern_type *fromEnd,
    const extern_type *&fromNext, intern_type *to, intern_type *toEnd, intern_type *&toNext) const {
    constexpr int longest = 2; // of a character in UTF-16
    static const codecvt_utf8_utf16<wchar_t> utf8;
    for (;;) {
        const result converted = utf8.in(state, from, fromEnd, fromNext, to, toEnd, toNext);
        if (converted == ok || fromNext == fromEnd || toEnd - toNext < longest)
            return converted;
        *toNext++ = L'\ufffd';
        to = toNext;
        from = fromNext + 1;
        state = {};
    }
}

} // namespace std
