#!/bin/sh
# sh adapter.sh: ranks of Hankel matrices by elimination in awk. See PROTOCOL.md: a question a line, an answer a line.
while IFS= read -r question; do printf '%s\n' "$question" | awk '
    /"call": "functions"/ { print "{\"functions\": [\"window_ranks\"]}"; exit }
    /NaN|Infinity/        { print "{\"refused\": \"r has samples that are not finite\"}"; exit }
    { match($0, /"windows": [0-9]+/); windows = substr($0, RSTART + 11, RLENGTH - 11) + 0
      sub(/.*"r": \[\[/, ""); sub(/\]\].*/, ""); N = split($0, row, /\], \[/)
      for (k = 1; k <= N; k++) { p = split(row[k], x, /, /); for (j = 1; j <= p; j++) { r[k, j] = x[j] + 0; size[j] += x[j] ^ 2 } }
      for (w = 1; w <= windows; w++) ranks = ranks (w > 1 ? ", " : "") rank(p * w, N - w + 1)
      print "{\"ranks\": [" ranks "]}" }
    function rank(height, width,    done, i, j, k, a, b, best, first, factor, M, t) {  # by complete pivoting
      for (i = 0; i < height; i++) for (k = 1; k <= width; k++) { j = i % p + 1; M[i, k] = r[k + int(i / p), j] / sqrt(size[j]) }
      for (done = 0; done < height; done++) {
        best = 0
        for (i = done; i < height; i++) for (k = done + 1; k <= width; k++) if (M[i, k] ^ 2 > best) { best = M[i, k] ^ 2; a = i; b = k }
        if (done == 0) first = best
        if (best <= 1e-20 * first) return done
        for (k = 1; k <= width; k++) { t = M[a, k]; M[a, k] = M[done, k]; M[done, k] = t }
        for (i = 0; i < height; i++) { t = M[i, b]; M[i, b] = M[i, done + 1]; M[i, done + 1] = t }
        for (i = done + 1; i < height; i++) { factor = M[i, done + 1] / M[done, done + 1]
          for (k = done + 1; k <= width; k++) M[i, k] -= factor * M[done, k] } }
      return height }'
done
