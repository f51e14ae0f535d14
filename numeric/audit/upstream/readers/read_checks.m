function failed = read_checks(folder, mine)
% READ_CHECKS  Put MINE, a struct of function handles, to the checks in FOLDER; needs nothing else, in Octave 7 or later as in MATLAB R2016b or
% later. Several answers come as a cell array {A, B, C, D}; structure gives a struct. Growth is left out. FAILED holds the names.
  files = dir(fullfile(folder, 'checks', '*.json'));  failed = {};  asked = 0;
  for k = 1:numel(files)
    text = fileread(fullfile(folder, 'checks', files(k).name));
    check = jsondecode(strrep(strrep(strrep(text, '"NaN"', 'null'), '"Infinity"', '179e306'), '"-Infinity"', '-179e306'));
    ask = isfield(mine, check.asks) && ~strcmp(check.demand, 'free') && isempty(check.growth);  asked = asked + ask;
    if ask && ~passes(check, mine.(check.asks)), failed{end+1} = check.name; fprintf('failed: %s\n', check.name); end %#ok<AGROW>
  end,  fprintf('%d checks, %d failed\n', asked, numel(failed));
end
function yes = passes(check, f)
  answers = {};  refuse = strcmp(check.demand, 'must-refuse');
  for k = 1:numel(check.calls)
    call = check.calls(k);  given = {call.arguments.floats};
    for j = 1:numel(given)
      if numel(call.arguments(j).shape) == 2, given{j} = reshape(given{j}, call.arguments(j).shape'); end
      given{j}(given{j} == 179e306) = inf;  given{j}(given{j} == -179e306) = -inf;  % JSON has no infinity
    end
    try answers{k} = f(given{:}); catch, yes = refuse || check.may_refuse; return; end %#ok<AGROW>
    for j = 1:numel(call.expected), if ~(ratio(call.expected(j), answers{k}) <= 1), yes = false; return; end, end
  end
  yes = ~refuse && (~strcmp(check.manner, 'deterministic') || isequal(answers{1}, answers{2}));
end
function worst = ratio(due, answer)  % how far the answer is off, over what is allowed
  true_ = due.floats;  bounds = due.bounds;  given = due.given;  worst = 0;
  if any(strcmp(due.of, {'markov', 'transfer', 'polynomial', 'eigenvalues'}))
    [A, B, C, D] = answer{:};  switch due.of
      case 'eigenvalues', worst = pairs(eig(A), complexes(true_), bounds); return;
      case 'polynomial',  got = poly(A);  got = got(2:end);
      case 'transfer',    got = D + C * ((given.z.floats * eye(size(A)) - A) \ B);
      otherwise, got = zeros([numel(true_) / numel(D), size(D)]);  got(1, :, :) = D;
        for k = 2:size(got, 1), got(k, :, :) = C * B;  B = A * B; end
    end
    worst = max([0; abs(got(:) - true_(:)) ./ bounds(:)]);
  elseif strcmp(due.of, 'residual'), off = answer - true_;
    for j = 1:numel(bounds)
      c = given.kernel_rows.floats;  if iscell(c), c = c{j}; else, c = reshape(c(j, :, :), size(c, 2), size(c, 3)); end
      d = size(c, 1) - 1;  seen = 0;  for k = 0:d, seen = seen + off(k+1:end-d+k, :) * c(k+1, :)'; end
      worst = max(worst, norm(seen) / bounds(j));
    end
  elseif strcmp(due.of, 'signal'), worst = norm(answer(1:size(true_, 1), :) - true_, 'fro') / bounds;
  elseif strcmp(due.of, 'space'), worst = sine(answer, true_) / bounds;
  elseif strcmp(due.of, 'responses')
    [A, C, Z] = answer{:};  n = size(A, 1);  f = Z(1:n, :);  units = diag(1 ./ given.units.floats(:));  got = units * Z(n+1:end, :);
    for k = 2:given.window.floats, got = [got; units * C * f];  f = A * f; end,  worst = sine(got, true_) / bounds; %#ok<AGROW>
  else
    if isstruct(answer), answer = answer.(due.of); end
    if strcmp(due.of, 'finite_zeros'), worst = pairs(answer, complexes(true_), bounds); elseif ~isequal(double(sort(answer(:))), double(sort(true_(:)))), worst = inf; end
  end
end
function z = complexes(x), x = reshape(x, [], 2);  z = complex(x(:, 1), x(:, 2)); end
function worst = pairs(got, true_, bounds)  % nearest pairs, narrow bounds first
  worst = 0;  [~, order] = sort(bounds(:)');  if numel(got) ~= numel(true_), worst = inf; return; end
  for k = order, [far, at] = min(abs(got - true_(k)));  worst = max(worst, far / bounds(k));  got(at) = []; end
end
function P = basis(M), [P, S, ~] = svd(M / max([abs(M(:)); realmin]), 'econ');  P = P(:, diag(S) > 1e-12 * max([S(:); 0])); end
function s = sine(got, true_)  % of the largest angle between the spaces of the columns, 1 where their dimensions differ
  P = basis(got);  Q = basis(true_);  if isequal(size(P), size(Q)), s = norm(P - Q * (Q' * P)); else, s = 1; end
end
