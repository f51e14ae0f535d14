#!/bin/sh
# sh adapter.sh: ranks of Hankel matrices in awk, by rotations and elimination. See PROTOCOL.md: a question a line, an answer a line.
while IFS= read -r question; do printf '%s\n' "$question" | awk '
    /"call": "functions"/ { print "{\"functions\": [\"window_ranks\"]}"; exit }
    /NaN|Infinity/        { print "{\"refused\": \"r has samples that are not finite\"}"; exit }
    { match($0, /"windows": [0-9]+/); windows = substr($0, RSTART + 11, RLENGTH - 11) + 0
      sub(/.*"r": \[\[/, ""); sub(/\]\].*/, ""); N = split($0, row, /\], \[/)
      if (N < windows) { print "{\"refused\": \"the record is shorter than the longest window\"}"; exit }
      for (k = 1; k <= N; k++) { p = split(row[k], x, /, /); for (j = 0; j < p; j++) { r[k * p + j] = x[j + 1] + 0; size[j] += x[j + 1] ^ 2 } }
      for (w = 1; w <= windows; w++) ranks = ranks (w > 1 ? ", " : "") rank(p * w, N - w + 1)
      print "{\"ranks\": [" ranks "]}" }
    function rank(height, width,    done, i, j, k, a, b, best, first, c, h, M, t) {
      for (k = 1; k <= width; k++) {  # one window after the other is rotated into a triangle
        for (i = 0; i < height; i++) c[i] = r[k * p + i] / sqrt(size[i % p])
        for (i = 0; i < height; i++) if (c[i] != 0) { h = sqrt(M[i, i] ^ 2 + c[i] ^ 2); a = M[i, i] / h; b = c[i] / h
          for (j = i; j < height; j++) { t = M[i, j]; M[i, j] = a * t + b * c[j]; c[j] = a * c[j] - b * t } } }
      for (done = 0; done < height; done++) {  # its rank by complete pivoting
        best = 0
        for (i = done; i < height; i++) for (k = done; k < height; k++) if (M[i, k] ^ 2 > best) { best = M[i, k] ^ 2; a = i; b = k }
        if (done == 0) first = best
        if (best <= 1e-20 * first) return done
        for (k = 0; k < height; k++) { t = M[a, k]; M[a, k] = M[done, k]; M[done, k] = t }
        for (i = 0; i < height; i++) { t = M[i, b]; M[i, b] = M[i, done]; M[i, done] = t }
        for (i = done + 1; i < height; i++) { t = M[i, done] / M[done, done]; for (k = done; k < height; k++) M[i, k] -= t * M[done, k] } }
      return height }'
done
