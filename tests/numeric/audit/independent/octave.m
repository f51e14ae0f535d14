1;  % An implementation in Octave, written from the audit's pages alone, by the standard algorithms of textbooks. It needs no package.

% Arguments

function x = signal(x, name, columns)  % a list of rows; jsondecode turns rows without entries into cells or nothing
  if iscell(x) && all(cellfun(@isempty, x(:))), x = zeros(numel(x), 0); end
  if ! isnumeric(x) || ndims(x) > 2 || ! all(isfinite(x(:))), error("%s must be a matrix of finite numbers", name); end
  if isempty(x) && nargin > 2, x = zeros(rows(x), columns); end
  x = double(x);
end

function [y, u] = record(q)
  y = signal(q.y, "y");  u = signal(q.u, "u");
  if rows(y) != rows(u), error("y has %d samples and u has %d", rows(y), rows(u)); end
end

function [A, B, C, D] = quadruple(A, B, C, D)
  A = signal(A, "A");  B = signal(B, "B");  C = signal(C, "C");  D = signal(D, "D");
  n = rows(A);  m = columns(D);  p = rows(D);
  if n == 0, A = zeros(0, 0);  B = zeros(0, m);  C = zeros(p, 0); end
  if ! isequal(size(A), [n n]) || ! isequal(size(B), [n m]) || ! isequal(size(C), [p n]), error("the shapes are those of no system"); end
end

% Windows and ranks

function s = sizes(x)  % the size of each column, 1 where it is silent
  top = max(abs([x; zeros(1, columns(x))]), [], 1);  top(top == 0) = 1;
  s = sqrt(mean((x ./ top) .^ 2, 1)) .* top;  s(! (s > 0)) = 1;
end

function H = hankel_rows(x, s)  % a row holds s samples that follow each other
  [N, p] = size(x);  H = zeros(N - s + 1, s * p);
  for j = 1:s, H(:, (j-1)*p+1 : j*p) = x(j : N-s+j, :); end
end

function R = factor_of(H), [~, R] = qr(H, 0); end

function t = rounding_of(M, samples)  % of a matrix, or of the factor of one with so many rows
  if nargin < 2, samples = columns(M); end
  t = 16 * eps * sqrt(max([samples, columns(M), 1])) * norm(M, "fro");
end

function k = rank_of(M, tolerance)
  if nargin < 2, tolerance = rounding_of(M); end
  k = sum(svd(M) > tolerance);
end

function ranks = window_ranks(r, windows)
  [N, p] = size(r);
  if N - windows + 1 < p * windows, error("%d samples are too few for %d windows of %d outputs", N, windows, p); end
  r = r ./ sizes(r);  ranks = zeros(1, windows);
  for s = 1:windows, R = factor_of(hankel_rows(r, s)); ranks(s) = rank_of(R, rounding_of(R, N)); end
end

function [k, ratio] = gap(sigma, floor_)  % where the singular values drop most, and by what factor
  sigma = max(sigma, floor_);  [ratio, k] = max(sigma(1:end-1) ./ sigma(2:end));
end

function [steps, noisy] = growth(x, offset)  % by how many the rank grows with a window in the long run; under noise a gap is a factor of 9
  [N, p] = size(x);  longest = min(20, floor((N + 1) / (p + 1)));
  if longest < 4, error("%d samples of %d channels are too few", N, p); end
  R = factor_of(hankel_rows(x ./ sizes(x), longest));
  exact = zeros(1, longest);  clear_ = nan(1, longest);
  for s = 1:longest
    part = R(1:s*p, 1:s*p);  sigma = svd(part);  t = rounding_of(part, N);  exact(s) = sum(sigma > t);
    if s * p > 1
      [k, ratio] = gap(sigma, t);
      if ratio > 9 && max(sigma(k+1), t) < 9 * max(sigma(end), t), clear_(s) = k; end
    end
  end
  if exact(end) < longest * p
    last = diff(exact)(end-2:end);
    if any(last != last(1)), error("the rank has not settled within the windows that the record allows"); end
    steps = last(1);  noisy = false;  return
  end
  noisy = true;
  for last = longest:-1:4
    d = diff(clear_(last-3:last));
    if ! any(isnan(d)) && all(d == d(1)) && d(1) >= offset && d(1) < p, steps = d(1); return, end
  end
  if longest < 20, error("all of %d windows have full rank, and the record allows no more", longest); end
  steps = p;
end

% Identification

function O = observability(A, C, s)
  O = zeros(s * rows(C), rows(A));  block = C;
  for j = 1:s, O((j-1)*rows(C)+1 : j*rows(C), :) = block;  block = block * A; end
end

function [A, B, C, D] = identify(y, u, n, s)
  [N, p] = size(y);  m = columns(u);  wide = N - 2*s + 1;  known = 2*s*m;
  if n != fix(n) || n < 0 || n > p * (s - 1), error("a window of %d carries no order %d with %d outputs", s, n, p); end
  if wide < known + max(n, 1), error("%d samples are too few for %d block rows of past and future", N, s); end
  of_y = sizes(y);  of_u = sizes(u);  y = y ./ of_y;  u = u ./ of_u;
  W = hankel_rows(u, 2*s);
  L = factor_of([W(:, s*m+1:end), W(:, 1:s*m), hankel_rows(y(s+1:end, :), s)])';
  inputs = L(1:known, 1:known);
  if m > 0 && svd(inputs)(end) <= rounding_of(inputs), error("the input does not excite the window"); end
  left = L(known+1:end, s*m+1:end);
  if rank_of(left, rounding_of(L)) > n, left = L(known+1:end, s*m+1:known); end
  [U, S] = svd(left);  sigma = diag(S(1:min(size(S)), 1:min(size(S))));
  if n > 0 && (numel(sigma) < n || sigma(n) <= rounding_of(L)), error("the data do not show %d states", n); end
  O = U(:, 1:n);
  if n > 0 && svd(O(1:end-p, :))(end) < 1e-2 * sqrt(eps), error("a window of %d is too short for these %d states", s, n); end
  A = O(1:end-p, :) \ O(p+1:end, :);  C = O(1:p, :);
  X = zeros(N*p, n + n*m + p*m);  state = [eye(n), zeros(n, n*m)];  each = eye(n);
  for k = 1:N
    X((k-1)*p+1 : k*p, :) = [C * state, kron(u(k, :), eye(p))];
    state = A * state;  state(:, n+1:end) += kron(u(k, :), each);
  end
  weight = norm(X, "columns");  weight(weight == 0) = 1;
  if ! all(isfinite(weight)), error("the model found is too unstable to be simulated over this record"); end
  theta = ((X ./ weight) \ y'(:)) ./ weight';
  B = reshape(theta(n+1 : n+n*m), n, m) ./ of_u;  D = of_y' .* reshape(theta(n+n*m+1 : end), p, m) ./ of_u;  C = of_y' .* C;
end

function r = residual(y, u, A, B, C, D)
  if columns(y) != rows(C) || columns(u) != columns(B), error("the record has other channels than the model"); end
  x = zeros(rows(A), 1);  r = y' - D * u';  driven = B * u';  X = zeros(rows(A), rows(y));
  for k = 1:rows(y), X(:, k) = x;  x = A * x + driven(:, k); end
  r = (r - C * X)';
end

% The fault space

function M = equations(kernel, A, C, s)  % every shift of the response of [f; g] is orthogonal to the kernel
  [p, n] = size(C);  response = [zeros(p, n), eye(p); observability(A, C, s), zeros(s*p, p)];  M = zeros(0, n + p);
  for j = 0:s-1, M = [M; kernel(:, j*p+1:end) * response(1:(s-j)*p, :)]; end
end

function Z = fault_space(r, A, C, n_v, s)
  [p, n] = size(C);
  if rows(A) != n || columns(A) != n || columns(r) != p, error("the shapes do not fit"); end
  if n_v > p || n_v < 0, error("%d faults in %d outputs have no fault space", n_v, p); end
  if s < 1 || rows(r) - s + 1 < p * s, error("%d samples are too few for %d block rows of %d outputs", rows(r), s, p); end
  of_r = sizes(r);  r = r ./ of_r;  C = C ./ of_r';
  of_x = ones(n, 1);
  if n > 0, [of_x, ~] = balance(A, "noperm");  of_x = diag(of_x);  of_x /= max(norm(C .* of_x'), realmin); end
   A = A ./ of_x .* of_x';  C = C .* of_x';
  R = factor_of(hankel_rows(r, s));  [~, S, V] = svd(R);  sigma = diag(S);  t = rounding_of(R, rows(r));  k = sum(sigma > t);
  before = 0;
  if s > 1, R = factor_of(hankel_rows(r, s - 1));  before = rank_of(R, rounding_of(R, rows(r))); end
  if k - before != n_v, error("%d faults do not show in these data: the rank grows by %d", n_v, k - before); end
  turned = 16 * eps;
  if k > 0, turned = max(turned, t / sigma(k)); end
  O = observability(A, C, s);  cancelled = 0;  % what cancels in C A^k leaves its rounding
  for j = 0:s-1, cancelled += norm(A ^ j, "fro"); end
  cancelled *= norm(abs(O) * abs(A), "fro");
  M = equations(V(:, k+1:end)', A, C, s);
  [~, S, V] = svd([M; zeros(n + p)]);
  Z = V(:, sum(diag(S) > turned * (1 + norm(O, "fro")) + 16 * eps * cancelled) + 1 : end);
  Z = [of_x .* Z(1:n, :); of_r' .* Z(n+1:end, :)];
end

% The fault signal

function v = reconstruct(r, A, F, C, G, x)
  [N, p] = size(r);  n = rows(A);  m = columns(F);
  if p != rows(C) || numel(x) != n || ! all(isfinite(x)), error("r, the model and x0 do not fit"); end
  of_r = sizes([C, G]')';  of_v = sizes([F; G]);  r = r ./ of_r';  C = C ./ of_r;  G = G ./ of_r ./ of_v;  F = F ./ of_v;
  s = min(16*(n + 1), N);  O = observability(A, C, s);  column = [G; O(1:(s-1)*p, :) * F];  T = zeros(s*p, s*m);
  for j = 1:s, T((j-1)*p+1:end, (j-1)*m+1 : j*m) = column(1:(s-j+1)*p, :); end
  if rank_of(T) - rank_of(T(p+1:end, m+1:end)) < m, error("the system is not left-invertible: the signal is not determined"); end
  inverse = pinv(T, 16 * eps * sqrt(numel(T)) * norm(T));
  first = inverse(1:m, :);  seen = first * hankel_rows(r, s)';  back = first * O;  v = zeros(N, m);  x = x(:);
  for k = 1:N-s, w = seen(:, k) - back * x;  v(k, :) = w';  x = A * x + F * w; end
  v(N-s+1:end, :) = reshape(inverse * (r(N-s+1:end, :)'(:) - O * x), m, s)';
  v = v ./ of_v;
end

% Zeros

function [U, k, least] = compressed(D, tolerance)  % the first rows of U' D are independent, the others vanish
  [U, S] = svd(D);  kept = diag(S)(1:min(size(D)));  kept = kept(kept > tolerance);
  k = numel(kept);  least = min([kept(:); Inf]);
end

function [A, B, C, D, ranks] = staircase(A, B, C, D, tolerance)  % Emami-Naeini and Van Dooren 1982
  ranks = [];  whole = norm([A, B; C, D], "fro");  % what vanishes grows by whole / least with each compression
  while true
    [U, k, least] = compressed(D, tolerance);  ranks(end+1) = k;  C = U' * C;  D = U' * D;
    [V, c, of_states] = compressed(C(k+1:end, :)', tolerance);
    tolerance = min(tolerance * max(1, whole / min(least, of_states)), max(tolerance, sqrt(eps) * whole));
    if c == 0, C = C(1:k, :);  D = D(1:k, :);  return, end
    V = [V(:, c+1:end), V(:, 1:c)];  f = rows(A) - c;
    A = V' * A * V;  B = V' * B;  C = C * V;
    C = [C(1:k, 1:f); A(f+1:end, 1:f)];  D = [D(1:k, :); B(f+1:end, :)];  A = A(1:f, 1:f);  B = B(1:f, :);
  end
end

function [normal_rank, zeros_, orders] = structure(A, F, C, G)
  for again = 1:4  % units of states, outputs and faults
    for i = 1:rows(A)
      others = [1:i-1, i+1:rows(A)];  out = norm([A(others, i); C(:, i)]);  into = norm([A(i, others), F(i, :)]);
      if out > 0 && into > 0
        unit = 2 ^ round(log2(into / out) / 2);  A(:, i) *= unit;  C(:, i) *= unit;  A(i, :) /= unit;  F(i, :) /= unit;
      end
    end
    f = sizes([F; G]);  F = F ./ f;  G = G ./ f;
    f = sizes([C, G]')';  C = C ./ f;  G = G ./ f;
  end
  tolerance = rounding_of([A, F; C, G]) * max(rows(A), 1);
  [A, F, C, G, ranks] = staircase(A, F, C, G, tolerance);  normal_rank = ranks(end);  orders = repelem(0:numel(ranks)-1, diff([0, ranks]));
  [A, C, F, G] = staircase(A', C', F', G', tolerance);  A = A';  C = C';  F = F';  G = G';
  n = rows(A);  zeros_ = zeros(0, 1);
  if n > 0
    K = eye(n);
    if rows(C) > 0, [~, ~, V] = svd([C, G]);  K = V(:, rows(C)+1:end); end
    zeros_ = eig([A, F] * K, K(1:n, :));
  end
end

% From outputs and inputs

function n_v = count_faults(y, u, n)
  p = columns(y);  m = columns(u);
  if n < 0 || n != fix(n), error("an order of %g is none", n); end
  if rows(y) < (p + m + 1) * (n + 3), error("%d samples are too few for order %d", rows(y), n); end
  [together, noisy] = growth([y, u], m);
  if together < m || (noisy && together == m + p), error("undecided"); end
  n_v = together - m;
end

function [A, C, Z] = identified_fault_space(y, u, n, n_v)
  [N, p] = size(y);  m = columns(u);  s = n + 2;
  if n_v > p || N < 4 * (p + m) * s, error("%d samples of %d outputs are too few for order %d", N, p, n); end
  [A, ~, C] = identify(y, u, n, s);
  of_y = sizes(y);  [~, S, V] = svd(factor_of(hankel_rows([u ./ sizes(u), y ./ of_y], s)));
  sigma = diag(S);  k = s * (m + n_v) + n;
  if n_v < p && sigma(k) < 9 * sigma(k+1), error("undecided"); end
  of_outputs = reshape(repmat([false(m, 1); true(p, 1)], s, 1), 1, []);
  M = equations(V(of_outputs, k+1:end)', A, C ./ of_y', s);
  [~, S, V] = svd([M; zeros(n + p)]);  sigma = diag(S);  [k, ratio] = gap(sigma, max(sigma(1), 1) * 16 * eps);
  if n_v == p, k = 0;  ratio = 9; end
  if ratio < 9, error("undecided"); end
  Z = V(:, k+1:end);  Z = [Z(1:n, :); of_y' .* Z(n+1:end, :)];
end

% The protocol: jsonencode rounds to fifteen digits and jsondecode is off by a unit in the last place, so matrices are printed and read here

function q = question(line)
  q = jsondecode(regexprep(line, '"(NaN|-?Infinity)"', 'null'));
  for name = fieldnames(q)'
    shape = size(q.(name{1}));  text = regexp(line, ['"' name{1} '": (\[[^"]*\])'], "tokens", "once");
    if isempty(text) || ! isnumeric(q.(name{1})), continue, end
    text = text{1};  text(text == "[" | text == "]" | text == ",") = " ";  x = sscanf(text, "%f");
    if numel(x) == prod(shape), q.(name{1}) = reshape(x, fliplr(shape))'; end
  end
end

function text = json(M)
  lines = cell(1, rows(M));
  for i = 1:rows(M), lines{i} = ["[" strjoin(arrayfun(@(x) sprintf("%.17g", x), M(i, :), "UniformOutput", false), ", ") "]"]; end
  text = ["[" strjoin(lines, ", ") "]"];
end

function text = answer(q)
  switch q.call
    case "functions"
      text = '{"functions": ["identify", "residual", "window_ranks", "fault_dimension", "fault_space", "reconstruct", "structure", "count_faults", "identified_fault_space"]}';
    case "identify"
      [y, u] = record(q);  [A, B, C, D] = identify(y, u, q.order, q.block_rows);
      text = sprintf('{"A": %s, "B": %s, "C": %s, "D": %s}', json(A), json(B), json(C), json(D));
    case "residual"
      [y, u] = record(q);  [A, B, C, D] = quadruple(q.A, q.B, q.C, q.D);
      text = sprintf('{"r": %s}', json(residual(y, u, A, B, C, D)));
    case "window_ranks",    text = sprintf('{"ranks": [%s]}', strjoin(cellstr(num2str(window_ranks(signal(q.r, "r"), q.windows)')), ", "));
    case "fault_dimension", text = sprintf('{"n_v": %d}', growth(signal(q.r, "r"), 0));
    case "fault_space"
      text = sprintf('{"basis": %s}', json(fault_space(signal(q.r, "r"), signal(q.A, "A"), signal(q.C, "C"), q.n_v, q.block_rows)));
    case "reconstruct"
      [A, F, C, G] = quadruple(q.A, q.F, q.C, q.G);
      text = sprintf('{"v": %s}', json(reconstruct(signal(q.r, "r"), A, F, C, G, q.x0)));
    case "structure"
      [A, F, C, G] = quadruple(q.A, q.F, q.C, q.G);  [rank_, zeros_, orders] = structure(A, F, C, G);
      truth = {"false", "true"}{1 + (rank_ == columns(G))};
      text = sprintf('{"normal_rank": %d, "finite_zeros": %s, "infinite_zero_orders": [%s], "left_invertible": %s}', rank_, ...
                     json([real(zeros_(:)), imag(zeros_(:))]), strjoin(cellstr(num2str(orders(:))), ", "), truth);
    case "count_faults",    [y, u] = record(q);  text = sprintf('{"n_v": %d}', count_faults(y, u, q.order));
    case "identified_fault_space"
      [y, u] = record(q);  [A, C, Z] = identified_fault_space(y, u, q.order, q.n_v);
      text = sprintf('{"A": %s, "C": %s, "basis": %s}', json(A), json(C), json(Z));
    otherwise, error("there is no function %s", q.call);
  end
end

warning("off", "all");
while true
  try line = input("", "s"); catch, exit(0); end  % fgetl would wait for what follows the line
  try text = answer(question(line));
  catch e, text = jsonencode(struct("refused", e.message)); end
  puts([text "\n"]);  fflush(stdout);
end
