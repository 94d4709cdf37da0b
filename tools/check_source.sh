#!/bin/sh
# What the library's own files must not hold: the heap, exceptions, the standard containers, printing, arithmetic that
# differs between machines, globals, includes against the direction of the folders, files that grew too long.
#
#   sh tools/check_source.sh        from anywhere; ends with `N passed, N failed`
set -u
cd "$(dirname "$0")/.." || exit 1
work="$(mktemp -d)" || exit 1
trap 'rm -rf "$work"' EXIT
. tools/common.sh

find include src -name '*.h' -o -name '*.cpp' | sort >"$work/files"

# The code without its comments and strings, as `file:line: text`.
while read -r file; do
  awk -v file="$file" '{
    text = $0
    if (text !~ /^[ \t]*#[ \t]*include/) gsub(/"([^"\\]|\\.)*"/, "\"\"", text)
    while (1) {
      if (inside) {
        end = index(text, "*/")
        if (!end) { text = ""; break }
        text = substr(text, end + 2); inside = 0
      }
      begin = match(text, /\/\/|\/\*/)
      if (!begin) break
      if (substr(text, begin, 2) == "//") { text = substr(text, 1, begin - 1); break }
      kept = kept substr(text, 1, begin - 1); text = substr(text, begin + 2); inside = 1
    }
    print file ":" NR ": " kept text
    kept = ""
  }' "$file"
done <"$work/files" >"$work/code"

# ban NAME PATTERN [EXCEPT]: no line of code may match the pattern, but for places that match the exception.
ban() {
  grep -E -- "$2" "$work/code" | grep -vE -- "${3:-^$}" >"$work/found"
  no_findings "$1" "$work/found"
}

word='(^|[^A-Za-z0-9_.>])'
# Placement new on arena memory, `new (place) T`, is no heap; a real one would show in tools/port/check_symbols.sh.
ban "no heap" "$word(malloc|calloc|realloc|free|alloca|aligned_alloc|posix_memalign) *\(|${word}new +[A-Za-z_:]|${word}delete( |\[)" \
  "= *delete;"
ban "no exceptions, no RTTI" "$word(throw|try|catch|dynamic_cast|typeid)[ (;{<]"
ban "no containers, strings, functions, threads of the standard library" \
  "std::(vector|string|map|set|multi|unordered_|list|deque|queue|stack|array|function|any|optional|variant|thread|mutex|atomic|shared_ptr|unique_ptr|sort|stable_sort|nth_element|hash|random|mt19937|[io]*stream|cout|cerr)"
ban "no arithmetic outside + - * / and the square root" \
  "std::(fma|sin|cos|tan|asin|acos|atan|exp|log|pow|cbrt|hypot|sinh|cosh|tanh|erf|tgamma|lgamma|fmod|remainder)|$word(fmaf?|sinf?|cosf?|tanf?|asinf?|acosf?|atan2?f?|expf?|exp2|expm1|logf?|log2|log10|log1p|powf?|cbrt|hypot|fmod) *\("
ban "square roots only by square_root" "std::sqrt|$word(sqrt|sqrtf|_mm_sqrt_sd) *\(" "^src/base/config.h"
ban "no long double, no fast arithmetic" "long double|__float128|__int128|fast-math|_Float16"
ban "no printing, no abort, no clock, no random numbers, no environment" \
  "$word(f?printf|sprintf|snprintf|puts|fputs|abort|exit|_Exit|assert|time|clock|rand|srand|getenv|setlocale|setjmp|longjmp) *\("
ban "no goto" "${word}goto "
ban "only small headers of the standard library" "# *include *<" \
  "<(cstddef|cstdint|cfloat|climits|cmath|cstring|limits|type_traits|new|cfenv|emmintrin\.h|xmmintrin\.h|immintrin\.h|stdint\.h|stddef\.h|stdbool\.h|sanitizer/asan_interface\.h)>"

# Includes run one way.
awk -F'[:]' '
  BEGIN {
    count = split("base mesh surface sample atlas plane result relax pipeline stream c", name, " ")
    for (i = 1; i <= count; ++i) rank[name[i]] = i
  }
  /# *include *"/ {
    split($1, part, "/"); match($0, /"[^"]*"/)
    target = substr($0, RSTART + 1, RLENGTH - 2); split(target, to, "/")
    from = part[1] == "include" ? 0 : part[2] == "io" ? 1.5 : rank[part[2]]
    if (part[1] == "src" && part[3] == "") next
    if (to[1] == "isolod") next
    if (part[1] == "include") { print $1 ":" $2 ": a public header includes " target; next }
    if (to[1] == "io" && part[2] == "io") next
    if (!(to[1] in rank)) print $1 ":" $2 ": includes " target ", which is in no folder of the library"
    else if (rank[to[1]] > from) print $1 ":" $2 ": includes " target ", which comes after " part[2]
  }' "$work/code" >"$work/found"
no_findings "includes run one way" "$work/found"

while read -r file; do
  lines="$(wc -l <"$file")"
  [ "$lines" -le 600 ] || echo "$file: $lines lines (600 at most)"
done <"$work/files" >"$work/found"
no_findings "files of 600 lines at most" "$work/found"

while read -r file; do
  case "$(head -n 1 "$file")" in
    //*) ;;
    *) case "$file" in *.cpp) [ -e "${file%.cpp}.h" ] || [ -e "include/isolod/$(basename "${file%.cpp}").h" ] ;; *) false ;; esac ||
      echo "$file: does not begin with a comment that says what it is" ;;
  esac
done <"$work/files" >"$work/found"
no_findings "each file says what it is" "$work/found"

# Every source of the core is in the unity file.
for file in src/base src/mesh src/surface src/sample src/atlas src/plane src/result src/relax src/pipeline src/c; do
  for source in "$file"/*.cpp; do
    [ -e "$source" ] || continue
    grep -qF "\"${source#src/}\"" src/isolod.cpp || echo "$source: not in src/isolod.cpp"
  done
done >"$work/found"
no_findings "the unity file holds every source" "$work/found"

# All sources in one share their unnamed namespaces.
if command -v c++ >/dev/null; then
  c++ -std=c++17 -ffp-contract=off -Iinclude -Isrc -fsyntax-only src/isolod.cpp >"$work/found" 2>&1
  no_findings "the unity file compiles" "$work/found"
fi

# A shared library shows what is marked, so every public function is.
grep -nE '^[A-Za-z_].*\(' include/isolod/*.h |
  grep -vE ':(ISOLOD_API|inline|constexpr|template|static|typedef|class|struct|enum) ' >"$work/found"
no_findings "public functions are marked ISOLOD_API" "$work/found"

while read -r file; do sed -n 's/^inline namespace \([a-z0-9_]*\) {$/\1/p' "$file"; done <"$work/files" | sort | uniq -c |
  sed 1d >"$work/found"
no_findings "all lies in one version namespace" "$work/found"

output="$(sed -n 's/^#define ISOLOD_OUTPUT_VERSION \([0-9]*\)$/\1/p' include/isolod/version.h)"
: >"$work/found"
grep -qE "^- Output ${output:-none}: [a-z]" README.md ||
  echo "README.md: no line '- Output $output: ...' in its change list" >"$work/found"
no_findings "the change list says why the output version is what it is" "$work/found"

echo "$passed passed, $failed failed"
[ "$failed" -eq 0 ]
