# Reads the output of `ctest -V` and prints what failed, what was skipped and why, and last "sums PASSED FAILED SKIPPED".
# A doctest program counts by its test cases ("test cases: 5 | 4 passed | 1 failed | 0 skipped"); any other test counts as one.
# A case that reported "[etalon] skipped: CASE: WHY" returned early: doctest calls it passed, here it is skipped.
# A program that died (or timed out) is one more failure, whatever its summary said before.

{ gsub(/\033\[[0-9;]*m/, "") }

# Output of test N comes as "N: text".
match($0, /^[0-9]+: /) {
  id = substr($0, 1, RLENGTH - 2)
  text = substr($0, RLENGTH + 1)
  if (text ~ /^\[doctest\] test cases:/) {
    summaries[id]++
    n = split(text, part, "|")
    for (i = 1; i <= n; i++) {
      if (match(part[i], /[0-9]+ passed/)) doctest_passed[id] += part[i] + 0
      if (match(part[i], /[0-9]+ failed/)) doctest_failed[id] += part[i] + 0
    }
  } else if (text ~ /^\[etalon\] skipped: /) {
    rest = substr(text, length("[etalon] skipped: ") + 1)
    name = rest
    sub(/: .*/, "", name)
    if (!((id, name) in seen)) { seen[id, name] = 1; skips[id]++; print text }
  } else if (text ~ /ERROR: |FATAL ERROR|TEST CASE:|^\[etalon\] failed: |Sanitizer/) {
    errors[id] = errors[id] "  " text "\n"
  }
  next
}

# "3/9 Test #3: base ....   Passed    0.01 sec"
match($0, /Test +#[0-9]+: /) && /sec *$/ {
  id = substr($0, RSTART, RLENGTH); gsub(/[^0-9]/, "", id)
  name = substr($0, RSTART + RLENGTH); sub(/ .*/, "", name)
  ok = ($0 ~ / Passed /); not_run = ($0 ~ /\*\*\*Skipped/)
  finished++
  if (summaries[id] > 0) {
    passed += doctest_passed[id] - skips[id]; failed += doctest_failed[id]; skipped += skips[id]
    if (!ok && doctest_failed[id] == 0) { failed++; died[id] = 1 }
    if (!ok) printf "[etalon] failed: %s: %d test cases%s\n%s", name, doctest_failed[id], died[id] ? ", and the program died" : "", errors[id]
  } else if (not_run) {
    skipped++
    if (skips[id] == 0) printf "[etalon] skipped: %s\n", name
  } else if (ok) {
    passed++
  } else {
    failed++
    printf "[etalon] failed: %s\n%s", name, errors[id]
  }
}

/Not Run/ && /Test +#/ && !/sec *$/ { failed++; print "[etalon] failed: " $0 }

END {
  if (finished == 0) { failed++; print "[etalon] failed: ctest ran no test" }
  printf "sums %d %d %d\n", passed, failed, skipped
}
