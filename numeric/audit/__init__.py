"""The audit: any numeric implementation against exact ground truth. The one folder where the exact and the numeric branch meet.

    running      `audit`, what all checks say of an implementation; `parametrize_with_checks`, the same as pytest cases
    outcome      the Audit that is returned
    adapter      what an implementation is: a few optional functions; PROTOCOL.md has them for other languages
    reference    our own numeric branch as an implementation
    records      Check, Measurement, CheckResult, and `perform`
    expectations failures that are known
    scoreboard   all that is installed against all checks: board.json, README's table, FINDINGS.md, reproducers

    diagnosing/  what is probably wrong with an answer that failed
    reports/     failures folded, JUnit, badges, versions
    upstream/    checks as data and as scripts, for those who do not have this
    reproducers/ scripts for some findings

    checks/      what is asked, one file a topic
    vectors/     exact systems, data, answers and derived bounds, as JSON that any language can read
    making/      how the vectors are computed
    subjects/    who is asked, and where it runs
    peers/       published packages as implementations

Comparisons are of what no state basis changes, in exact arithmetic where the answer allows.
"""
