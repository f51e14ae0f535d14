# Put a Julia file to the checks in FOLDER: julia read_checks.jl FOLDER MINE.jl (needs the package JSON; growth is left out).
# MINE.jl defines some of the functions; several answers come as a tuple (A, B, C, D), structure gives a NamedTuple or a Dict.
import JSON; using LinearAlgebra
number(x) = x isa AbstractString ? parse(Float64, replace(x, "Infinity" => "Inf")) : Float64(x)
numbers(x, shape = sizes(x)) =  # nested lists, row after row
    isempty(shape) ? number(x) : permutedims(reshape(leaves(x), reverse(Tuple(Int.(shape)))), length(shape):-1:1)
leaves(x) = x isa AbstractVector ? reduce(vcat, map(leaves, x); init = Float64[]) : [number(x)]
sizes(x) = x isa AbstractVector ? (length(x), (isempty(x) ? () : sizes(x[1]))...) : ()
complexes(x) = [complex(number(z[1]), number(z[2])) for z in x]
function pairs_off(got, true_, bounds)  # nearest pairs, narrow bounds first
    length(got) == length(true_) || return Inf
    left, worst = collect(ComplexF64, got), 0.0
    for k in sortperm(Float64.(bounds))
        far, at = findmin(abs.(left .- true_[k])); worst = max(worst, far / bounds[k]); deleteat!(left, at)
    end
    return worst
end
basis(M) = (F = svd(M / max(mapreduce(abs, max, M; init = 0.0), floatmin())); F.U[:, F.S .> 1e-12 * reduce(max, F.S; init = 0.0)])
angle_of(P, Q) = size(P) == size(Q) ? opnorm(P - Q * (Q' * P)) : 1.0
sine(got, true_) = angle_of(basis(got), basis(true_))  # of the largest angle between the spaces of the columns, 1 for unlike dimensions
charpoly_tail(A) = real(foldl((c, z) -> [c; 0] - z * [0; c], eigvals(A); init = [1.0 + 0im]))[2:end]
powers(A, B, C, D, count) = [k == 0 ? D : C * A^(k - 1) * B for k in 0:count-1]
function ratio(due, answer)  # how far the answer is off, over what is allowed
    of, truth, bounds = due["of"], due["floats"], due["bounds"]
    given = Dict(name => one["floats"] for (name, one) in due["given"])
    of == "eigenvalues" && return pairs_off(eigvals(answer[1]), complexes(truth), bounds)
    within(got) = reduce(max, abs.(got - numbers(truth)) ./ numbers(bounds); init = 0.0)
    of == "polynomial" && return within(charpoly_tail(answer[1]))
    of == "transfer" && return within(reshape(answer[4] + answer[3] * ((given["z"] * I - answer[1]) \ answer[2]), 1, size(answer[4])...))
    of == "markov" && return within(permutedims(cat(powers(answer..., length(truth))...; dims = 3), (3, 1, 2)))
    seen(c, off) = norm(sum(off[k:end-size(c, 1)+k, :] * c[k, :] for k in axes(c, 1)))
    of == "residual" && return reduce(max, [seen(numbers(c), answer - numbers(truth)) / b for (c, b) in zip(given["kernel_rows"], bounds)]; init = 0.0)
    of == "signal" && return norm(answer[1:length(truth), :] - numbers(truth)) / bounds
    of == "space" && return sine(answer, numbers(truth)) / bounds
    stacked(A, C, Z) = vcat(Z[size(A, 1)+1:end, :], (C * A^k * Z[1:size(A, 1), :] for k in 0:given["window"]-2)...)
    of == "responses" && return sine(stacked(answer...) ./ repeat(Float64.(given["units"]), given["window"]), numbers(truth)) / bounds
    got = of in ("ranks", "count") ? answer : answer isa AbstractDict ? answer[of] : getproperty(answer, Symbol(of))
    of == "finite_zeros" && return pairs_off(got, complexes(truth), bounds)
    return sort(vec(collect(got))) == sort(vec(collect(truth))) ? 0.0 : Inf
end
function passes(check, f)
    answers, refuse = Any[], check["demand"] == "must-refuse"
    for call in check["calls"]
        given = Any[one["shape"] === nothing ? one["floats"] : numbers(one["floats"], one["shape"]) for one in call["arguments"]]
        kept = deepcopy(given); answer = try f(given...) catch; nothing end
        answer === nothing && return refuse || check["may_refuse"]
        push!(answers, answer)
        all(due -> ratio(due, answer) <= 1, call["expected"]) || return false
        check["manner"] == "inputs-untouched" && !isequal(kept, given) && return false
    end
    return !refuse && (check["manner"] != "deterministic" || isequal(answers[1], answers[2]))
end
files = filter(endswith(".json"), readdir(joinpath(ARGS[1], "checks"); join = true))
include(abspath(ARGS[2]))
checks = filter(c -> isdefined(Main, Symbol(c["asks"])) && c["demand"] != "free" && c["growth"] === nothing, map(JSON.parsefile, files))
failed = [c["name"] for c in checks if !passes(c, getfield(Main, Symbol(c["asks"])))]
println(join(["failed: " * name for name in failed], "\n"), "\n", length(checks), " checks, ", length(failed), " failed")
exit(isempty(failed) ? 0 : 1)
