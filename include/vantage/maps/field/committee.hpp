namespace vantage {
template <class, class, class>
struct BayesianCommittee;
}
