function mine = minimal()
% MINIMAL  For Octave and MATLAB, a struct of functions that need nothing of anybody's.
  mine = struct('identify', @identify, 'residual', @residual, 'window_ranks', @window_ranks, 'fault_dimension', @fault_dimension);
end
function finite(varargin)
  for k = 1:nargin, if ~all(isfinite(varargin{k}(:))), error('entries that are not finite'); end, end
end
function H = hankel_of(signal, s)
  [N, p] = size(signal);  if N < s * (p + 1) - 1, error('too few samples'); end
  H = zeros(p * s, N - s + 1);  for k = 1:s, H((k-1)*p+1:k*p, :) = signal(k:N-s+k, :)'; end
end
function s = sizes(signal), s = sqrt(mean(signal .^ 2, 1));  s(s == 0) = 1; end
function k = rank_of(M), values = svd(M);  k = sum(values > 1e-11 * values(1)); end
function ranks = window_ranks(r, windows)
  finite(r);  ranks = zeros(1, windows);  for s = 1:windows, ranks(s) = rank_of(hankel_of(r ./ sizes(r), s)); end
end
function n_v = fault_dimension(r), ranks = window_ranks(r, 9);  n_v = ranks(9) - ranks(8); end
function left = residual(y, u, A, B, C, D)
  finite(y, u, A, B, C, D);  if size(y, 1) ~= size(u, 1), error('unequal lengths'); end
  if size(y, 2) ~= size(C, 1), error('more or fewer outputs than C has rows'); end
  x = zeros(size(A, 1), 1);  left = y;
  for k = 1:size(y, 1), left(k, :) = y(k, :) - (C * x + D * u(k, :)')';  x = A * x + B * u(k, :)'; end
end
function model = identify(y, u, n, s)
  finite(y, u);  p = size(y, 2);  n_u = size(u, 2);  if size(y, 1) ~= size(u, 1), error('unequal lengths'); end
  units = sizes(y);  inputs = sizes(u);  y = y ./ units;  u = u ./ inputs;  Y = hankel_of(y, s);  U = hankel_of(u, s);
  if size(Y, 2) < size(Y, 1) + size(U, 1) || rank_of(U) < size(U, 1) || rank_of([U; Y]) ~= size(U, 1) + n, error('no such model'); end
  [left, S, ~] = svd(Y - Y * pinv(U) * U, 'econ');  O = left(:, 1:n) * sqrt(S(1:n, 1:n));
  if rank_of(O(1:end-p, :)) < n, error('the window does not determine A'); end
  A = O(1:end-p, :) \ O(p+1:end, :);  C = O(1:p, :);  states = [eye(n), zeros(n, n * n_u)];  rows_ = [];
  for k = 1:size(u, 1)
    rows_ = [rows_; C * states, kron(u(k, :), eye(p))]; %#ok<AGROW>
    states = A * states;  states(:, n+1:end) = states(:, n+1:end) + kron(u(k, :), eye(n));
  end
  found = rows_ \ reshape(y', [], 1);  found = found(n+1:end);
  B = reshape(found(1:n*n_u), n, n_u);  D = reshape(found(n*n_u+1:end), p, n_u);
  model = {A, B ./ inputs, C .* units', D .* units' ./ inputs};
end
