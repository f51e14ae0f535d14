1;  % octave-cli --quiet adapter.m: counts faults by ranks of Hankel matrices. See PROTOCOL.md.
function ranks = window_ranks(r, windows, noisy = false)  % noisy: the rank is where the singular values drop most
  if any(! isfinite(r(:))), error("r has samples that are not finite"); end
  [N, p] = size(r);  r = r ./ max(sqrt(mean(r .^ 2)), realmin);  ranks = zeros(1, windows);
  if N < (p + 1) * windows - 1, error("%d samples are too few for %d windows", N, windows); end
  for s = 1:windows
    R = reshape(permute(reshape(r((1:s)' + (0:N-s), :), s, N - s + 1, p), [3 1 2]), p * s, []);
    sigma = svd(R);  ranks(s) = sum(sigma > 1e-11 * sigma(1));  % column k of R: r(k), ..., r(k+s-1)
    if noisy && ranks(s) == p * s && s > 1, [~, ranks(s)] = max(sigma(1:end-1) ./ sigma(2:end)); end
  end
end
while true
  try line = input("", "s"); catch, exit(0); end  % fgetl would wait for what follows the line
  q = jsondecode(regexprep(line, '"(NaN|-?Infinity)"', 'null'));
  try
    switch q.call
      case "functions",       a.functions = {"window_ranks", "fault_dimension"};
      case "window_ranks",    a.ranks = num2cell(window_ranks(q.r, q.windows));
      case "fault_dimension"  % at the longest window that the record fills, of 11 at most
        s = min(11, floor((rows(q.r) + 1) / (columns(q.r) + 1)));
        if s < 3, error("%d samples are too few", rows(q.r)); end
        a.n_v = diff(window_ranks(q.r, s, true))(end);
    end
  catch e, a = struct("refused", e.message); end
  puts([jsonencode(a) "\n"]); fflush(stdout); clear a
end
